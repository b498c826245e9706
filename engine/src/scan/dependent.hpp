// SPDX-License-Identifier: Apache-2.0
// Readings of one scan that are no distinct evidence (Sensor::dependence): they are made one source for each cell
// first, and that source meets the cell once, when the scan is over. The kernels know nothing of it: they fuse each
// reading into cells that have heard nothing, and what those hold then is what the reading says.
#pragma once
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "evigrid/map.hpp"
#include "grid/tile_store.hpp"

namespace evigrid {

/// Of one worker and one policy: what a scan's readings say together. Of independent ones (with a learned revision,
/// scan/revised.hpp): what a single reading says.
class DependentReadings {
 public:
  /// What the kernel left in `heard`, a micro-tile of `planes` that had heard nothing, joins what was said of `micro`.
  void add(const Sensor&, float* micro, const float* heard);
  /// Calls visit(micro) for all that was spoken of.
  template <class Visit>
  void each_micro(Visit&& visit) const {
    for (const Told& t : told_) visit(t.micro);
  }
  [[nodiscard]] bool empty() const noexcept { return told_.empty(); }
  /// Combines it with the cells by the map's rule, and forgets it.
  void fuse(const MapParams&, const TileStore&, kernels::Stats&);

 private:
  struct Told {
    float* micro;
    std::uint32_t readings[kernels::kMicroCells];
    float first[3][kernels::kMicroCells];    // masses of the first reading
    double weight[2][kernels::kMicroCells];  // l = ln(1 + x/v) for empty and for occupied, of all
  };
  [[nodiscard]] static bool source_of(Dependence, const Told&, int cell, float* x, float* y, float* v);

  Dependence policy_{};
  std::vector<Told> told_;
  std::unordered_map<const float*, std::size_t> place_;
  std::vector<float> cells_;  // gathered planes: the cells', the source's, the conflict
};

/// Micro-tiles that have heard nothing, for the kernels to write one reading into.
class BlankMicros {
 public:
  /// `count` of them side by side, each plane as nothing was ever said.
  float* blank(const std::vector<Plane>& planes, std::size_t count);

 private:
  struct alignas(64) Line {
    float cell[kernels::kMicroCells];
  };
  std::vector<Line> lines_;
};

}  // namespace evigrid
