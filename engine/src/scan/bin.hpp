// SPDX-License-Identifier: Apache-2.0
// Binning: which readings each tile has to fuse, in their order.
#pragma once
#include <cstdint>
#include <vector>

#include "grid/tile_store.hpp"
#include "scan/compiled.hpp"
#include "scan/footprint.hpp"

namespace evigrid {

struct TileWork {
  Tile* tile;
  std::vector<std::uint32_t> footprints;  // ascending: the order of fusion
};

/// Creates missing tiles (std::length_error at the memory cap, before any cell is
/// changed). Sorted by tile, so that the schedule does not depend on a hash.
std::vector<TileWork> bin(const std::vector<Footprint>&, const kernels::KernelTable&, TileStore&);

}  // namespace evigrid
