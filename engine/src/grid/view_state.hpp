// SPDX-License-Identifier: Apache-2.0
// What a MapView holds: the catalog of its age, and what the map said of itself. Gives its age back when it goes.
#pragma once
#include <memory>
#include <vector>

#include "evigrid/map.hpp"
#include "grid/admission.hpp"
#include "grid/tile_catalog.hpp"

namespace evigrid {

class ViewState final : public TileSource {
 public:
  struct Facts {
    MapParams params;
    std::shared_ptr<const std::vector<Sensor>> sensors;
    Losses losses;
    Admission admission;  // for a file of it
  };
  ViewState(const TileStore& store, std::shared_ptr<const Catalog>, Facts);
  ~ViewState() override;
  ViewState(const ViewState&) = delete;
  ViewState& operator=(const ViewState&) = delete;

  [[nodiscard]] const float* cells_of(TileIndex) const noexcept override;
  [[nodiscard]] std::size_t size() const noexcept override { return tiles_; }
  [[nodiscard]] std::vector<TileRef> in_order() const override;
  [[nodiscard]] Changes changes(std::uint64_t since) const;
  [[nodiscard]] const Facts& facts() const noexcept { return facts_; }

 private:
  std::shared_ptr<TileAges> ages_;
  std::shared_ptr<const Catalog> catalog_;
  Facts facts_;
  std::size_t tiles_;
  std::uint64_t age_;
};

}  // namespace evigrid
