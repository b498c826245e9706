// SPDX-License-Identifier: Apache-2.0
// --base-frame, --fixed-frame, --topics: what a user may say of a ROS bag.
#pragma once
#include "cli.hpp"

#include "log/bag_options.hpp"

namespace evigrid::driver {

void add_bag_options(CLI::App& command, BagOptions& bag);

}  // namespace evigrid::driver
