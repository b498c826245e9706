// SPDX-License-Identifier: Apache-2.0
// Binning: which readings reach which tiles, listed in parallel, and which tiles one task fuses. A region is some tiles
// that lie together; within it readings come in their order, so every cell meets them in order, whoever runs the
// region.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "evigrid/executor.hpp"
#include "grid/admission.hpp"
#include "scan/reach_list.hpp"

namespace evigrid {

/// A reading that may touch a tile.
struct Reach {
  std::uint32_t footprint, tile;  // places in the batch
};

struct TileWork {
  TileIndex at;
  Tile* tile = nullptr;
  std::uint32_t readings = 0, region = 0;
  BlockMask reached = 0;  // by the batch's readings, and whether any may have changed a cell: its region's task says
  bool touched = false;
};

struct Plan {
  std::vector<TileWork> tiles;
  std::vector<Reach> reaches;               // region by region, in each by footprint
  std::vector<std::uint32_t> region_begin;  // places in reaches; one more than regions
  [[nodiscard]] std::size_t regions() const noexcept { return region_begin.size() - 1; }
  [[nodiscard]] std::span<const Reach> region(std::size_t i) const noexcept {
    return std::span(reaches).subspan(region_begin[i], region_begin[i + 1] - region_begin[i]);
  }

  std::vector<ReachList> lists;  // the first lists_used of them, each of per_list footprints
  std::size_t lists_used = 0, per_list = 1;
  std::vector<ConeFootprint> cone;  // by footprint; of fans: anything
  [[nodiscard]] const kernels::ConeCuts* bands(std::uint32_t footprint) const noexcept {
    return lists[footprint / per_list].bands(cone[footprint]);
  }

  // Kept for their memory.
  std::vector<std::uint32_t> order;
  std::vector<Reach> unsorted;
  std::uint64_t batch = 0;
};

enum class Missing : bool { left_out, made };
/// Compiles the footprints, and creates missing tiles unless they are left out (std::length_error at the memory cap,
/// before any cell is changed). Tiles that admission refuses are not reached.
void bin(std::vector<Footprint>&, const kernels::KernelTable&, TileStore&, const Admission&, Missing, Executor&, Plan&);

}  // namespace evigrid
