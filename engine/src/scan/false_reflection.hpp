// SPDX-License-Identifier: Apache-2.0
// False reflections (Li et al. 2014): sound that comes back over a second surface makes one sonar of a ring read
// another range than its neighbours. Δ = |d1 − d2| of two neighbours is what the scene itself does there; the next one
// stays when |d3 − d2| < Δ + tolerance.
#pragma once
#include <cstddef>
#include <vector>

namespace evigrid {

struct RingReading {
  std::size_t index;   ///< of the reading in its scan
  double bearing_rad;  ///< where its sensor looks, in the robot's frame
  float range_m;       ///< NaN: none that could be compared
};

/// Indices of the readings to drop, ascending. Neighbours: next to one another by bearing, going round, at most 60°
/// apart. Whoever lacks one of the two neighbours before it, or their readings, stays: nothing speaks against it.
std::vector<std::size_t> false_reflections(std::vector<RingReading> ring, double tolerance_m);

}  // namespace evigrid
