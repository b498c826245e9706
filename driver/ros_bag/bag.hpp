// SPDX-License-Identifier: Apache-2.0
// ROS bags (version 2.0, of rosbag v1) in plain types. A library of its own, since the headers of ROS 1 are C++17 and
// no later: nothing of theirs is seen outside, nothing of ours inside.
#pragma once
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace evigrid::ros_bag {

/// What is wrong with a bag, without its name.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// nav_msgs/OccupancyGrid.
struct Grid {
  std::string topic, frame;
  std::int64_t stamp_ns = 0;                  ///< since 1970; what ROS cannot say becomes its smallest time
  double resolution_m = 0, x_m = 0, y_m = 0;  ///< origin: of the lower left corner
  std::uint32_t width = 0, height = 0;
  std::vector<std::int8_t> data;  ///< row-major, smallest y first
};
/// One message, one connection. Throws Error.
void write_grid(const std::string& file, const Grid& grid);
/// The first of a topic. Throws Error.
Grid read_grid(const std::string& file, const std::string& topic);

/// A frame seen from above.
struct Placed {
  double x_m = 0, y_m = 0, yaw_rad = 0;  ///< yaw: of its x axis
  bool upside_down = false;              ///< its y axis is to the right
  double tilt_rad = 0;                   ///< between its z axis and the vertical
};

/// sensor_msgs/LaserScan or sensor_msgs/Range.
struct SensorMessage {
  std::size_t number = 0;  ///< in the bag, from 1
  std::string topic;
  bool laser = false;
  std::int64_t stamp_ns = 0;  ///< of the header, else when it was recorded
  std::string frame;
  float least_m = 0, most_m = 0;
  float first_rad = 0, step_rad = 0;  ///< lasers
  float aperture_rad = 0;             ///< sonars: field of view
  bool infrared = false;
  std::vector<float> ranges_m;
  std::optional<Placed> base, mount;  ///< base in the fixed frame, sensor in the base, at the stamp
  std::string why;                    ///< where tf could not say
};

/// Of a reader: what it finds, in the order of the bag.
class Listener {
 public:
  virtual ~Listener() = default;
  virtual void sensor(const SensorMessage&) = 0;
  virtual void other(const std::string& type) = 0;  ///< a message of no use, or of a topic not asked for
  virtual void broken(std::size_t number, const std::string& why) = 0;  ///< it cannot be decoded
};

struct Frames {
  std::string base = "base_link";
  std::string fixed;  ///< empty: map where tf knows it, else odom
};
struct Summary {
  std::string fixed;
  std::uint64_t transforms = 0, transforms_refused = 0;
};
/// Reads twice: transforms first, since they may come after the scan that they belong to. Throws Error.
Summary read(const std::string& file, const Frames& frames, const std::vector<std::string>& topics, Listener& listener);

}  // namespace evigrid::ros_bag
