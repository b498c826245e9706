// SPDX-License-Identifier: Apache-2.0
#include "frames.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace evigrid::ros_bag {

std::string frame_name(const std::string& id) { return !id.empty() && id.front() == '/' ? id.substr(1) : id; }

void FrameTree::add(geometry_msgs::TransformStamped t, bool is_static) {
  ++added;
  t.header.frame_id = frame_name(t.header.frame_id);
  t.child_frame_id = frame_name(t.child_frame_id);
  const auto& p = t.transform.translation;
  const bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  try {
    if (!finite || !buffer_.setTransform(t, "bag", is_static)) ++refused;
  } catch (const std::exception&) {  // times beyond ROS's
    ++refused;
  }
}

std::optional<Placed> FrameTree::find(const std::string& target, const std::string& frame, ros::Time at,
                                      std::string& why) const {
  geometry_msgs::TransformStamped t;
  try {
    t = buffer_.lookupTransform(target, frame, at);
  } catch (const std::exception& none) {  // tf2's, and ROS's for times beyond its own
    why = none.what();
    return std::nullopt;
  }
  const auto& q = t.transform.rotation;
  const Eigen::Matrix3d turn = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  Placed out;
  out.x_m = t.transform.translation.x;
  out.y_m = t.transform.translation.y;
  out.yaw_rad = std::atan2(turn(1, 0), turn(0, 0));
  out.upside_down = turn(2, 2) < 0;
  out.tilt_rad = std::acos(std::min(1.0, std::abs(turn(2, 2))));
  return out;
}

}  // namespace evigrid::ros_bag
