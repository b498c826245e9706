// SPDX-License-Identifier: Apache-2.0
// Where frames lay at a time, in the plane: tf2's buffer over a whole bag.
#pragma once
#include <geometry_msgs/TransformStamped.h>
#include <tf2/buffer_core.h>

#include <optional>
#include <string>

#include "bag.hpp"

namespace evigrid::ros_bag {

/// tf 1 wrote "/map", tf 2 writes "map".
std::string frame_name(const std::string& id);

class FrameTree {
 public:
  explicit FrameTree(double seconds) : buffer_(ros::Duration(seconds)) {}
  /// Counts what tf2 refuses (a frame in itself, NaN, no rotation).
  void add(geometry_msgs::TransformStamped transform, bool is_static);
  [[nodiscard]] bool knows(const std::string& frame) const { return buffer_._frameExists(frame); }
  /// Of `frame` in `target`; nullopt and why when tf cannot say.
  [[nodiscard]] std::optional<Placed> find(const std::string& target, const std::string& frame, ros::Time at,
                                           std::string& why) const;
  std::uint64_t added = 0, refused = 0;

 private:
  tf2::BufferCore buffer_;
};

}  // namespace evigrid::ros_bag
