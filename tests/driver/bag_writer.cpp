// SPDX-License-Identifier: Apache-2.0
#include "bag_writer.hpp"

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>
#include <std_msgs/Header.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Geometry>

namespace evigrid::testing {
namespace {

std_msgs::Header header(double t_s, const std::string& frame) {
  std_msgs::Header out;
  out.stamp = ros::Time(t_s);
  out.frame_id = frame;
  return out;
}

geometry_msgs::Quaternion quaternion(double roll, double pitch, double yaw) {
  const Eigen::Quaterniond q = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
  geometry_msgs::Quaternion out;
  out.x = q.x(), out.y = q.y(), out.z = q.z(), out.w = q.w();
  return out;
}

}  // namespace

struct BagWriter::Impl {
  rosbag::Bag bag;
};

BagWriter::BagWriter(const std::string& file, Packed packed) : impl_(new Impl) {
  impl_->bag.open(file, rosbag::bagmode::Write);
  impl_->bag.setChunkThreshold(2000);  // several chunks
  impl_->bag.setCompression(packed == Packed::no    ? rosbag::compression::Uncompressed
                            : packed == Packed::bz2 ? rosbag::compression::BZ2
                                                    : rosbag::compression::LZ4);
}
BagWriter::~BagWriter() = default;

void BagWriter::transform(double t_s, const std::string& parent, const std::string& child, const std::vector<double>& v,
                          bool fixed) {
  geometry_msgs::TransformStamped t;
  t.header = header(t_s, parent);
  t.child_frame_id = child;
  t.transform.translation.x = v[0], t.transform.translation.y = v[1], t.transform.translation.z = v[2];
  t.transform.rotation = quaternion(v[3], v[4], v[5]);
  tf2_msgs::TFMessage message;
  message.transforms.push_back(t);
  impl_->bag.write(fixed ? "/tf_static" : "/tf", ros::Time(t_s), message);
}

void BagWriter::odometry(double t_s, const std::string& frame, const std::string& child, double x_m, double y_m,
                         double yaw_rad) {
  nav_msgs::Odometry o;
  o.header = header(t_s, frame);
  o.child_frame_id = child;
  o.pose.pose.position.x = x_m, o.pose.pose.position.y = y_m;
  o.pose.pose.orientation = quaternion(0, 0, yaw_rad);
  impl_->bag.write("/odom", ros::Time(t_s), o);
}

void BagWriter::laser(double t_s, const std::string& topic, const std::string& frame, float first_rad, float step_rad,
                      const std::vector<float>& ranges_m, float least_m, float most_m) {
  sensor_msgs::LaserScan s;
  s.header = header(t_s, frame);
  s.angle_min = first_rad;
  s.angle_increment = step_rad;
  s.angle_max = first_rad + step_rad * static_cast<float>(ranges_m.size() - 1);
  s.range_min = least_m, s.range_max = most_m;
  s.ranges = ranges_m;
  impl_->bag.write(topic, ros::Time(t_s), s);
}

void BagWriter::range(double t_s, const std::string& topic, const std::string& frame, float range_m, float aperture_rad,
                      float least_m, float most_m) {
  sensor_msgs::Range r;
  r.header = header(t_s, frame);
  r.radiation_type = sensor_msgs::Range::ULTRASOUND;
  r.field_of_view = aperture_rad;
  r.min_range = least_m, r.max_range = most_m, r.range = range_m;
  impl_->bag.write(topic, ros::Time(t_s), r);
}

void BagWriter::text(double t_s, const std::string& topic, const std::string& words) {
  impl_->bag.write(topic, ros::Time(t_s), header(t_s, words));
}

void BagWriter::close() { impl_->bag.close(); }

}  // namespace evigrid::testing
