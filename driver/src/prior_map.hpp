// SPDX-License-Identifier: Apache-2.0
// A floor plan of another program as an evidential map.
#pragma once
#include "evigrid/map.hpp"
#include "evigrid/scenes/plan.hpp"

namespace evigrid::driver {

struct PriorOptions {
  Rule rule = Rule::pcr5;
  /// In (0, 1]: an occupancy of P per cent becomes m(occupied) = P/100·certainty, m(empty) = (1 − P/100)·certainty.
  double certainty = 0.9;
};

struct PriorMap {
  Map map;
  bool aligned = false;  ///< pixels are cells of the grid, one to one; else each cell took the pixel under its centre
};

/// Cells are as large as pixels. Unknown pixels stay unseen. Throws InputError where the plan is no grid (pixels that
/// are not square) or larger than a map may be.
PriorMap map_of(const scenes::FloorPlan& plan, const PriorOptions& options);

}  // namespace evigrid::driver
