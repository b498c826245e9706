// SPDX-License-Identifier: Apache-2.0
// Several ways of fusing one input, judged side by side.
#pragma once
#include <string>
#include <vector>

#include "log/bag_options.hpp"
#include "options.hpp"
#include "world_input.hpp"

namespace evigrid::driver {

struct CompareOptions {
  BagOptions bag;                   ///< of a ROS bag among the inputs
  std::vector<std::string> inputs;  ///< log files, or one scene; none: `world`, or the default scene
  WorldOptions world;
  std::vector<std::string> rules, models;
  std::vector<std::string> robots;  ///< for scenes and worlds; empty: the scene's own
  MappingOptions mapping;           ///< everything but rule and model
};

/// Writes compare.csv, compare.md, report.json and sheet.png. Throws InputError.
void compare(const CompareOptions& options);

}  // namespace evigrid::driver
