// SPDX-License-Identifier: Apache-2.0
// The micro-tiles that cones may touch, as the kernels take them: three lists, one a zone, filled for many cones before
// the first is fused, so that cells can be fetched ahead.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "grid/change_log.hpp"
#include "grid/tile_store.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid {

/// The micro-tiles of one cone, on the map. In each band of four rows of cells, columns cut[0] … cut[5] part rim,
/// within, free, within, rim.
struct ConeFootprint {
  std::int64_t column = 0, row = 0;  // micro-tile of the map that is column 0 of band 0
  float x0 = 0, y0 = 0;              // offset of its first cell centre from the apex
  std::uint32_t first_band = 0;      // place in ConeFootprints
  int bands = 0;
  int micros = 0;  // that it may touch
};

/// The bands of some cones.
class ConeFootprints {
 public:
  void clear() noexcept { bands_.clear(); }
  ConeFootprint find(const kernels::KernelTable&, const kernels::ConeReading&);
  [[nodiscard]] const kernels::ConeCuts* bands(const ConeFootprint& f) const noexcept {
    return bands_.data() + f.first_band;
  }
  /// Calls visit(TileIndex) for each tile that may be touched.
  template <class Visit>
  void each_tile(const ConeFootprint&, Visit visit) const;

 private:
  std::vector<kernels::ConeCuts> bands_;
  std::vector<float> cuts_;
};

class ConeList {
 public:
  /// Numbers of micro-tiles listed so far, a zone.
  using Marks = std::array<int, kernels::kConeZones>;
  [[nodiscard]] const Marks& marks() const noexcept { return count_; }
  [[nodiscard]] int size() const noexcept { return count_[0] + count_[1] + count_[2]; }
  void clear() noexcept { count_ = {}; }
  /// What the footprint may touch of one tile; answers the blocks that this lies in.
  BlockMask add(const kernels::KernelTable&, const ConeFootprint&, const kernels::ConeCuts* bands, const Tile&,
                int planes);
  /// What was listed between two marks.
  [[nodiscard]] kernels::ConeArgs args(const Marks& from, const Marks& to) const noexcept;

 private:
  struct Zone {
    std::vector<float*> cells;
    std::vector<float> x, y;
    /// For what one more tile may have, behind what is listed.
    kernels::ListedMicros room(int listed) {
      constexpr std::size_t kTile = kernels::kMicrosPerTile + std::max(kernels::kListAtOnce, kernels::kConeAhead);
      const auto had = static_cast<std::size_t>(listed);
      if (cells.size() < had + kTile) {
        cells.resize(2 * (had + kTile));
        x.resize(cells.size());
        y.resize(cells.size());
      }
      return {cells.data() + had, x.data() + had, y.data() + had, 0};
    }
  };
  std::array<Zone, kernels::kConeZones> zones_;
  Marks count_{};
};

template <class Visit>
void ConeFootprints::each_tile(const ConeFootprint& f, Visit visit) const {
  constexpr int kNone = 1 << 30;
  const kernels::ConeCuts* const band = bands(f);
  for (int i = 0; i < f.bands;) {
    const std::int64_t y = (f.row + i) >> 4;
    const int end = static_cast<int>(std::min<std::int64_t>(f.bands, y * 16 + 16 - f.row));
    int from = kNone, to = -kNone;
    for (; i < end; ++i) {
      const auto& cut = band[i].column;
      const bool any = cut[0] < cut[5];
      from = any ? std::min(from, cut[0]) : from;
      to = any ? std::max(to, cut[5]) : to;
    }
    if (from > to) continue;
    const std::int64_t last = (f.column + to - 1) >> 4;
    for (std::int64_t x = (f.column + from) >> 4; x <= last; ++x) visit(TileIndex{y, x});
  }
}

}  // namespace evigrid
