// SPDX-License-Identifier: Apache-2.0
// Pictures for a sheet, of maps that come and go one after the other while the box around them all still grows. Kept
// is a picture of each, never its planes: those made before the box was whole are made again in the end.
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "picture/sheet.hpp"

namespace evigrid::driver {

class GrowingSheet {
 public:
  /// `box`: what all pictures show, or none: the box around all maps.
  explicit GrowingSheet(int panel_px, std::optional<CellRect> box = {}) : panel_px_(panel_px), fixed_(box) {}
  void add(const Layers& map);
  /// The pictures in the order of the maps. `again` gives map i once more, where its picture shows too little.
  [[nodiscard]] std::vector<Thumbnail> finish(const std::function<Layers(std::size_t i)>& again);

 private:
  [[nodiscard]] const CellRect& box() const { return fixed_ ? *fixed_ : around_all_; }
  struct Made {
    CellRect shows;
    Thumbnail picture;
  };
  int panel_px_;
  std::optional<CellRect> fixed_;
  CellRect around_all_{};
  std::vector<Made> made_;
};

}  // namespace evigrid::driver
