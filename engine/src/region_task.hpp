// SPDX-License-Identifier: Apache-2.0
// The fusion of one region of tiles: its readings in their order, whoever runs it.
#pragma once
#include <cstdint>
#include <span>

#include "integrate.hpp"
#include "scratch.hpp"

namespace evigrid {

/// What all regions of a batch of scans share.
struct Batch {
  const Pipeline& p;
  Scratch& s;
  kernels::RuleArgs rule;
  bool dependent = false;  // some sensor's readings of one scan are no distinct evidence
};
struct RegionResult {
  kernels::Stats stats;
  std::uint64_t tiles = 0;  ///< reached
};
/// Marks the tiles that it changed (TileWork::touched).
RegionResult fuse_region(const Batch&, RegionScratch&, std::span<const Reach>);

}  // namespace evigrid
