// SPDX-License-Identifier: Apache-2.0
// The flowchart of Li, Huang & Dezert 2006 (Fig. 14.9) to the letter: a cell's readings wait until there are five, then
// those are fused in their order. Cell by cell in double, the model written down from its equations: slow, and so a
// second opinion on the map that fuses each reading when it comes.
#pragma once
#include <vector>

#include "evigrid/scenes/truth.hpp"
#include "log/log.hpp"
#include "out/layers.hpp"

namespace evigrid::driver {

struct FiveReadings {
  Layers layers;                  ///< of the rectangle asked for; conflict: sum of k
  std::vector<std::size_t> read;  ///< readings of each cell, the waiting ones too
};
/// Every sensor is a sonar of the model li2006, without discount.
[[nodiscard]] FiveReadings fuse_by_fives(const Log& sonars, Rule rule, double cell_m, const CellRect& rect);

}  // namespace evigrid::driver
