// SPDX-License-Identifier: Apache-2.0
// Sonars and lasers of a ROS bag as a log, and a map as a bag. Optional: built where Debian's librosbag-storage-dev,
// libtf2-dev and the messages are installed (EVIGRID_ROSBAG); driver/ros_bag is all that knows them. Frames are REP
// 105's: map (or, without one, odom) ─► base ─► sensor, from tf, tf_static and, where no tf moves the base,
// nav_msgs/Odometry. Ranges are REP 117's, as the engine takes them: +inf nothing within range, −inf too close, NaN
// invalid.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "export/export.hpp"
#include "log/bag_options.hpp"
#include "log/log.hpp"

namespace evigrid::driver {

bool bags_are_built() noexcept;
/// Throws InputError "WHAT: this evigrid was built without …" where they are not.
void require_bags(const std::string& what);
/// Throws InputError naming the option where any was given: what is read is no bag.
void refuse_bag_options(const BagOptions& given);

/// One nav_msgs/OccupancyGrid of the rectangle at the map's last stamp, in options.frame on options.topic.
void write_grid_bag(const Exported& what, const ExportOptions& options, const std::filesystem::path& file);

/// Throws InputError naming the file when it is no bag, is damaged (`rosbag reindex` mends some), or no transform names
/// its frames. A message that cannot be used is counted by reason in log.malformed.
void read_bag(const std::string& path, const BagOptions& options, Log& log);

}  // namespace evigrid::driver
