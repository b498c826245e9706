// SPDX-License-Identifier: Apache-2.0
#include "bag/frame_options.hpp"
#include <CLI/CLI.hpp>

namespace evigrid::driver {

void add_bag_options(CLI::App& command, BagOptions& bag) {
  command.add_option("--base-frame", bag.base_frame, "ROS bags: the robot's frame (REP 105)")->capture_default_str();
  command.add_option("--fixed-frame", bag.fixed_frame,
                     "ROS bags: the frame of the map (default: map where tf knows it, else odom)");
  command.add_option("--topics", bag.topics, "ROS bags: these sensors alone, comma-separated (default: all)")
      ->delimiter(',')
      ->allow_extra_args(false);
}

}  // namespace evigrid::driver
