// SPDX-License-Identifier: Apache-2.0
#include <nav_msgs/OccupancyGrid.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <limits>

#include "bag.hpp"
#include "check.hpp"

namespace evigrid::ros_bag {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

/// ROS 1 counts unsigned seconds of 32 bits, and 0 is no time.
ros::Time ros_time(std::int64_t stamp_ns) {
  if (stamp_ns < 1 || stamp_ns / kSecond > std::int64_t{std::numeric_limits<std::uint32_t>::max()})
    return ros::TIME_MIN;
  return {static_cast<std::uint32_t>(stamp_ns / kSecond), static_cast<std::uint32_t>(stamp_ns % kSecond)};
}

}  // namespace

void write_grid(const std::string& file, const Grid& g) {
  nav_msgs::OccupancyGrid grid;
  grid.header.frame_id = g.frame;
  grid.header.stamp = grid.info.map_load_time = ros_time(g.stamp_ns);
  grid.info.resolution = static_cast<float>(g.resolution_m);
  grid.info.width = g.width;
  grid.info.height = g.height;
  grid.info.origin.position.x = g.x_m;
  grid.info.origin.position.y = g.y_m;
  grid.info.origin.orientation.w = 1;
  grid.data = g.data;
  try {
    rosbag::Bag bag(file, rosbag::bagmode::Write);
    bag.write(g.topic, grid.header.stamp, grid);
    bag.close();
  } catch (const ros::Exception& bad) {
    throw Error(bad.what());
  }
}

Grid read_grid(const std::string& file, const std::string& topic) {
  try {
    check_structure(file);
    rosbag::Bag bag;
    bag.open(file, rosbag::bagmode::Read);
    rosbag::View view(bag, rosbag::TopicQuery(topic));
    for (const rosbag::MessageInstance& message : view) {
      const auto grid = message.instantiate<nav_msgs::OccupancyGrid>();
      if (!grid) continue;
      Grid out{topic,
               grid->header.frame_id,
               std::int64_t{grid->header.stamp.sec} * kSecond + grid->header.stamp.nsec,
               static_cast<double>(grid->info.resolution),
               grid->info.origin.position.x,
               grid->info.origin.position.y,
               grid->info.width,
               grid->info.height,
               grid->data};
      return out;
    }
  } catch (const ros::Exception& bad) {
    throw Error(bad.what());
  }
  throw Error("holds no nav_msgs/OccupancyGrid on " + topic);
}

}  // namespace evigrid::ros_bag
