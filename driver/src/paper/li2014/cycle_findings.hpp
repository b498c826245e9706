// SPDX-License-Identifier: Apache-2.0
// What the drives of the GERM robot have in common to report: its cycles of 100 ms.
#pragma once
#include <string>
#include <vector>

#include "paper/finding.hpp"
#include "paper/li2014/germ_robot.hpp"

namespace evigrid::driver {

/// Counted over the cycles of several runs of the agents.
struct GermTally {
  std::size_t runs = 0, walls = 0, movers = 0, plans = 0, avoided = 0, cycles = 0, late = 0;
  double most_ms = 0, sum_ms = 0;
  void add(const GermRun& run);
};
/// How often it planned and avoided, touched something, and took longer than a cycle. @param cycle_aim of the last.
[[nodiscard]] std::vector<Finding> cycle_findings(const GermTally& tally, Aim cycle_aim);

/// Fusion of one scan within the cycle.
[[nodiscard]] Finding cycle_kept(const std::string& name, double most_ms, double mean_ms, Aim aim);

}  // namespace evigrid::driver
