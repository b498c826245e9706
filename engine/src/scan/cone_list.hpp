// SPDX-License-Identifier: Apache-2.0
// The micro-tiles that cones may touch, as the kernels take them: three lists, one a zone, filled for many cones before
// the first is fused, so that cells can be fetched ahead.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "grid/tile_store.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid {

/// The micro-tiles of one cone, on the map.
class ConeFootprint {
 public:
  void find(const kernels::KernelTable&, const kernels::ConeReading&);
  /// Calls visit(TileIndex) for each tile that may be touched.
  template <class Visit>
  void each_tile(Visit visit) const;

 private:
  friend class ConeList;
  [[nodiscard]] int cut(int c, int band) const noexcept {
    return static_cast<int>(cuts_[static_cast<std::size_t>(c * bands_.capacity + band)]);
  }
  std::int64_t column_ = 0, row_ = 0;  // micro-tile of the map that is column 0 of band 0
  float x0_ = 0, y0_ = 0;              // offset of its first cell centre from the apex
  kernels::ConeBands bands_;
  std::vector<float> cuts_;
};

class ConeList {
 public:
  /// Numbers of micro-tiles listed so far, a zone.
  using Marks = std::array<int, kernels::kConeZones>;
  [[nodiscard]] const Marks& marks() const noexcept { return count_; }
  [[nodiscard]] int size() const noexcept { return count_[0] + count_[1] + count_[2]; }
  void clear() noexcept { count_ = {}; }
  /// What the footprint may touch of one tile. True when that is anything.
  bool add(const ConeFootprint&, const Tile&, int planes);
  /// What was listed between two marks.
  [[nodiscard]] kernels::ConeArgs args(const Marks& from, const Marks& to) const noexcept;

 private:
  struct Zone {
    std::vector<float*> cells;
    std::vector<float> x, y;
  };
  std::array<Zone, kernels::kConeZones> zones_;
  Marks count_{};
};

template <class Visit>
void ConeFootprint::each_tile(Visit visit) const {
  constexpr int kNone = 1 << 30;
  for (int band = 0; band < bands_.count;) {
    const std::int64_t y = (row_ + band) >> 4;
    int from = kNone, to = -kNone;
    for (; band < bands_.count && (row_ + band) >> 4 == y; ++band) {
      const int a = cut(0, band), b = cut(kernels::ConeBands::kCuts - 1, band);
      if (a < b) from = std::min(from, a), to = std::max(to, b);
    }
    if (from > to) continue;
    const std::int64_t last = (column_ + to - 1) >> 4;
    for (std::int64_t x = (column_ + from) >> 4; x <= last; ++x) visit(TileIndex{y, x});
  }
}

}  // namespace evigrid
