// SPDX-License-Identifier: Apache-2.0
// What a user may say of a ROS bag.
#pragma once
#include <string>
#include <vector>

namespace evigrid::driver {

struct BagOptions {
  std::string base_frame = "base_link";
  std::string fixed_frame;          ///< empty: map where tf knows it, else odom
  std::vector<std::string> topics;  ///< of sensors; empty: every sensor_msgs/LaserScan and sensor_msgs/Range
};

}  // namespace evigrid::driver
