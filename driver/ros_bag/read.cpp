// SPDX-License-Identifier: Apache-2.0
#include <console_bridge/console.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <new>
#include <set>

#include "check.hpp"
#include "frames.hpp"

namespace evigrid::ros_bag {
namespace {

constexpr double kMostSpan_s = 1e6;
constexpr std::uint32_t kMostMessage = 1u << 28;  // bytes

using rosbag::MessageInstance;

/// Why one message is of no use.
struct Broken {
  std::string why;
};

/// roscpp's own decoder throws where bytes are missing.
template <class T>
boost::shared_ptr<T> decoded(const MessageInstance& message) {
  try {
    if (message.size() > kMostMessage) throw Broken{"too large"};
    std::vector<std::uint8_t> bytes(message.size());
    ros::serialization::OStream copy(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    message.write(copy);
    if (!counts_fit(message.getDataType(), bytes.data(), bytes.size()))
      throw Broken{"a count is larger than the message"};
    if (auto out = message.instantiate<T>()) return out;
  } catch (const ros::Exception& bad) {
    throw Broken{bad.what()};
  } catch (const std::bad_alloc&) {
    throw Broken{"asks for more memory than there is"};
  }
  throw Broken{"another definition of " + message.getDataType()};
}

std::int64_t nanoseconds(const ros::Time& at) { return std::int64_t{at.sec} * 1'000'000'000 + at.nsec; }

class Reader {
 public:
  Reader(const rosbag::Bag& bag, const Frames& frames, const std::vector<std::string>& topics, Listener& to)
      : frames_(frames), topics_(topics), view_(bag), to_(to), tree_(span_s() + 10) {}

  Summary read() {
    gather_transforms();
    const std::string base = frame_name(frames_.base);
    std::string fixed = frame_name(frames_.fixed);
    if (fixed.empty()) fixed = tree_.knows("map") ? "map" : "odom";
    for (const std::string& frame : {base, fixed}) {
      if (!tree_.knows(frame)) throw Error("no transform and no odometry names the frame '" + frame + "'");
    }
    each([&](const MessageInstance& message, std::size_t number) {
      const std::string &type = message.getDataType(), topic = message.getTopic();
      const bool asked = topics_.empty() || std::find(topics_.begin(), topics_.end(), topic) != topics_.end();
      const bool laser = type == "sensor_msgs/LaserScan", sonar = type == "sensor_msgs/Range";
      if (!asked || !(laser || sonar)) return to_.other(type);
      SensorMessage out;
      out.number = number;
      out.topic = topic;
      out.laser = laser;
      const std_msgs::Header header = laser ? fill(out, *decoded<sensor_msgs::LaserScan>(message))
                                            : fill(out, *decoded<sensor_msgs::Range>(message));
      const ros::Time at = header.stamp.isZero() ? message.getTime() : header.stamp;
      out.stamp_ns = nanoseconds(at);
      out.frame = frame_name(header.frame_id);
      out.base = tree_.find(fixed, base, at, out.why);
      if (out.base) out.mount = tree_.find(base, out.frame, at, out.why);
      to_.sensor(out);
    });
    return {fixed, tree_.added, tree_.refused};
  }

 private:
  double span_s() {
    if (view_.size() == 0) throw Error("is a bag without messages");
    const double s = (view_.getEndTime() - view_.getBeginTime()).toSec();
    if (!(s >= 0 && s < kMostSpan_s)) throw Error("spans " + std::to_string(s) + " s, which no drive does");
    return s;
  }

  template <class F>
  void each(F&& f) {
    std::size_t number = 0;
    for (const MessageInstance& message : view_) {
      ++number;
      try {
        f(message, number);
      } catch (const Broken& broken) {
        to_.broken(number, broken.why);
      }
    }
  }

  void gather_transforms() {
    std::set<std::string> moved;  // children that tf moves
    std::vector<boost::shared_ptr<nav_msgs::Odometry>> odometry;
    each([&](const MessageInstance& message, std::size_t) {
      const std::string& type = message.getDataType();
      if (type == "tf2_msgs/TFMessage" || type == "tf/tfMessage") {
        const bool fixed = frame_name(message.getTopic()) == "tf_static";
        const auto all = decoded<tf2_msgs::TFMessage>(message);
        for (const auto& t : all->transforms) {
          moved.insert(frame_name(t.child_frame_id));
          tree_.add(t, fixed);
        }
      } else if (type == "nav_msgs/Odometry") {
        odometry.push_back(decoded<nav_msgs::Odometry>(message));
      }
    });
    for (const auto& o : odometry) {
      const std::string child = frame_name(o->child_frame_id.empty() ? frames_.base : o->child_frame_id);
      if (moved.count(child) != 0) continue;  // tf says it, too
      geometry_msgs::TransformStamped t;
      t.header = o->header;
      t.child_frame_id = child;
      t.transform.translation.x = o->pose.pose.position.x;
      t.transform.translation.y = o->pose.pose.position.y;
      t.transform.translation.z = o->pose.pose.position.z;
      t.transform.rotation = o->pose.pose.orientation;
      tree_.add(t, false);
    }
  }

  static std_msgs::Header fill(SensorMessage& out, const sensor_msgs::LaserScan& scan) {
    out.least_m = scan.range_min;
    out.most_m = scan.range_max;
    out.first_rad = scan.angle_min;
    out.step_rad = scan.angle_increment;
    out.ranges_m = scan.ranges;
    return scan.header;
  }
  static std_msgs::Header fill(SensorMessage& out, const sensor_msgs::Range& echo) {
    out.least_m = echo.min_range;
    out.most_m = echo.max_range;
    out.aperture_rad = echo.field_of_view;
    out.infrared = echo.radiation_type == sensor_msgs::Range::INFRARED;
    out.ranges_m.assign(1, echo.range);
    return echo.header;
  }

  const Frames& frames_;
  const std::vector<std::string>& topics_;
  rosbag::View view_;
  Listener& to_;
  FrameTree tree_;
};

}  // namespace

Summary read(const std::string& file, const Frames& frames, const std::vector<std::string>& topics, Listener& to) {
  console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_NONE);  // what matters comes as an exception
  try {
    check_structure(file);
    rosbag::Bag bag;  // opened afterwards: its constructor would lose what it read when it throws
    bag.open(file, rosbag::bagmode::Read);
    return Reader(bag, frames, topics, to).read();
  } catch (const ros::Exception& bad) {  // rosbag's and roscpp's
    throw Error(bad.what());
  } catch (const std::bad_alloc&) {
    throw Error("is damaged: it asks for more memory than there is");
  } catch (const Error&) {
    throw;
  } catch (const std::logic_error&) {  // the listener's own
    throw;
  } catch (const std::runtime_error& bad) {  // times beyond ROS's
    throw Error(bad.what());
  }
}

}  // namespace evigrid::ros_bag
