// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bag/bag.hpp"
#include "error.hpp"
#include "log/fields.hpp"
#include "ros_bag/bag.hpp"

namespace evigrid::driver {
namespace {

constexpr double kMostTilt = 0.35;                 // rad: a beam that climbs more has left the plane within a room
constexpr double kMoved_m = 1e-3, kTurned = 2e-3;  // a mount that differs by more is another sensor
constexpr std::size_t kMostSensors = 256, kMostBeams = 100000;

Pose2 pose_of(const ros_bag::Placed& p) { return {p.x_m, p.y_m, p.yaw_rad}; }

class ToLog final : public ros_bag::Listener {
 public:
  ToLog(const std::string& path, Log& log) : path_(path), log_(log) {}
  void other(const std::string& type) override { log_.skip(type); }
  void broken(std::size_t number, const std::string& why) override {
    log_.reject(path_, number, "cannot be decoded", printable(why));
  }
  void sensor(const ros_bag::SensorMessage& message) override {
    try {
      append(message);
    } catch (const Malformed& bad) {
      log_.reject(path_, message.number, bad.reason, bad.detail);
    }
  }

 private:
  void append(const ros_bag::SensorMessage& m) {
    if (!m.mount) throw Malformed{"no transform", printable(m.why)};
    if (std::max(m.base->tilt_rad, m.mount->tilt_rad) > kMostTilt || m.base->upside_down)
      throw Malformed{"tilted", fmt::format("frame '{}' is not level", printable(m.frame))};
    if (m.ranges_m.empty() || m.ranges_m.size() > kMostBeams)
      throw Malformed{"wrong count", fmt::format("{} ranges", m.ranges_m.size())};
    Sensor s;
    s.T_robot_sensor = pose_of(*m.mount);
    s.min_range_m = std::max(0.0, static_cast<double>(m.least_m));
    s.max_range_m = s.no_return_m = static_cast<double>(m.most_m);  // beyond it a sensor says nothing (sensor_msgs)
    if (m.laser) {
      s.model = Model::beam;
      s.beams = static_cast<int>(m.ranges_m.size());
      s.first_beam_rad = static_cast<double>(m.first_rad);
      s.beam_step_rad = static_cast<double>(m.step_rad);
    } else {
      s.aperture_rad = static_cast<double>(m.aperture_rad);
    }
    const bool turned = m.laser && seen_from_above(s, m.mount->upside_down);
    const std::size_t sensor = sensor_of(m, s);
    values_.clear();
    for (const float r : m.ranges_m) values_.push_back(range_m(static_cast<double>(r), log_));
    if (turned) std::reverse(values_.begin(), values_.end());
    if (m.laser) {
      append_fan(log_, sensor, m.stamp_ns, pose_of(*m.base), values_);
    } else {
      append_cones(log_, sensor, m.stamp_ns, pose_of(*m.base), values_);
    }
  }

  /// Makes the beams turn counter-clockwise as seen from above; whether their order had to be turned for it.
  static bool seen_from_above(Sensor& s, bool upside_down) {
    if (upside_down) s.first_beam_rad = -s.first_beam_rad, s.beam_step_rad = -s.beam_step_rad;
    if (!(s.beam_step_rad < 0)) return false;
    s.first_beam_rad += s.beam_step_rad * (s.beams - 1);
    s.beam_step_rad = -s.beam_step_rad;
    return true;
  }

  std::size_t sensor_of(const ros_bag::SensorMessage& m, const Sensor& s) {
    const std::string topic = printable(m.topic);
    const auto same = [&](const LogSensor& known) {
      const Sensor& k = known.sensor;
      const Pose2 &a = k.T_robot_sensor, &b = s.T_robot_sensor;
      return known.name == topic && k.model == s.model && k.beams == s.beams && k.first_beam_rad == s.first_beam_rad &&
             k.beam_step_rad == s.beam_step_rad && k.min_range_m == s.min_range_m && k.max_range_m == s.max_range_m &&
             k.aperture_rad == s.aperture_rad && std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) <= kMoved_m &&
             std::abs(std::remainder(a.yaw_rad - b.yaw_rad, 2 * M_PI)) <= kTurned;
    };
    const auto found = std::find_if(log_.sensors.begin(), log_.sensors.end(), same);
    if (found != log_.sensors.end()) return static_cast<std::size_t>(found - log_.sensors.begin());
    if (const auto errors = check(s); !errors.empty())
      throw Malformed{"bad geometry", errors.front().field + " " + errors.front().reason};
    if (log_.sensors.size() >= kMostSensors)
      throw Malformed{"too many sensors", fmt::format("over {} different geometries", kMostSensors)};
    log_.sensors.push_back({m.laser ? "laser" : m.infrared ? "ir" : "sonar", s, topic});
    return log_.sensors.size() - 1;
  }

  const std::string& path_;
  Log& log_;
  std::vector<float> values_;
};

}  // namespace

void read_bag(const std::string& path, const BagOptions& options, Log& log) {
  require_bags(path);
  ToLog to(path, log);
  try {
    const ros_bag::Summary summary = ros_bag::read(path, {options.base_frame, options.fixed_frame}, options.topics, to);
    log.poses = summary.fixed == "odom" ? Poses::dead_reckoned : Poses::recorded;
    log.facts["transforms"] = static_cast<double>(summary.transforms);
    if (summary.transforms_refused > 0)
      log.facts["transforms_refused"] = static_cast<double>(summary.transforms_refused);
  } catch (const ros_bag::Error& bad) {
    throw InputError(fmt::format("{}: {}", path, printable(bad.what())));
  }
  std::stable_sort(log.scans.begin(), log.scans.end(),
                   [](const LogScan& a, const LogScan& b) { return a.stamp_ns < b.stamp_ns; });
}

}  // namespace evigrid::driver
