// SPDX-License-Identifier: Apache-2.0
// Laser logs of the Wean Hall exercises (CMU 16-831), blank-separated:
//   L x y theta xl yl thetal r1..r180 ts     a scan, with the robot's and the laser's odometry pose
//   O x y theta ts                           odometry alone: counted, a map needs scans
// Centimetres, radians counter-clockwise, seconds; beams from right to left; ≥ 8183 cm = no return.
// The source says "180 readings over 180°", no more. Each beam is taken as the middle of its own degree: first −89.5°,
// step 1°. On both published logs the scans of 4 m of driving then overlay in fewer 4 cm cells than with first −90°
// (20051 against 20786, 24089 against 24319; −88.5° and −91° are worse on average).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "log/fields.hpp"
#include "log/formats.hpp"

namespace evigrid::driver {
namespace {

constexpr std::size_t kBeams = 180, kPoseFields = 6, kScanFields = 1 + kPoseFields + kBeams + 1, kOdometryFields = 5;
constexpr double kCm = 0.01;
constexpr Pose2 kMount{0.25, 0, 0};      // T_robot_sensor: 25 cm ahead
constexpr double kSamePlace_m = 0.01;    // the recorded laser pose and the mount agree to rounding, or do not
constexpr double kNoReturn_cm = 8182.5;  // 8183 and the error codes above it, safe from rounding to float

Sensor scanner() {
  Sensor s;
  s.model = Model::beam;
  s.T_robot_sensor = kMount;
  s.beams = static_cast<int>(kBeams);
  s.first_beam_rad = -89.5 * kDeg;
  s.beam_step_rad = 1 * kDeg;
  s.min_range_m = 0.05;
  s.max_range_m = 10.0;
  s.no_return_m = kNoReturn_cm * kCm;
  return s;
}

bool looks_like_wean(const FirstLine& line) {
  double ignored = 0;
  return (line.blanks[0] == "L" || line.blanks[0] == "O") && line.blanks.size() > 3 &&
         parse_number(line.blanks[1], ignored) && parse_number(line.blanks[2], ignored);
}

/// How far the recorded laser pose is from where the mount puts it; a deviation is counted, the mount is used.
void check_mount(const Pose2& T_map_robot, const Pose2& T_map_laser, Log& log) {
  const Pose2 expected = compose(T_map_robot, kMount);
  const double off_m = std::hypot(expected.x_m - T_map_laser.x_m, expected.y_m - T_map_laser.y_m);
  const double turned_rad = std::abs(std::remainder(expected.yaw_rad - T_map_laser.yaw_rad, 360 * kDeg));
  if (!std::isfinite(off_m) || !std::isfinite(turned_rad)) return;  // the engine counts poses that are none
  double& most_m = log.facts["laser_pose_deviation_max_m"];
  most_m = std::max(most_m, off_m);
  log.facts["laser_poses_off_mount"] += off_m > kSamePlace_m || turned_rad > kSamePlace_m ? 1 : 0;
}

void read_scan(const Tokens& t, Log& log, std::vector<float>& scratch) {
  expect_fields(t.size(), kScanFields);
  const Pose2 robot{number(t, 1) * kCm, number(t, 2) * kCm, number(t, 3)};
  const Pose2 laser{number(t, 4) * kCm, number(t, 5) * kCm, number(t, 6)};
  const std::int64_t stamp = stamp_ns(number(t, kScanFields - 1));
  scratch.clear();
  for (std::size_t i = 0; i < kBeams; ++i) scratch.push_back(range_m(number(t, 1 + kPoseFields + i) * kCm, log));
  check_mount(robot, laser, log);
  append_fan(log, sensor_index(log, "laser", scanner()), stamp, robot, scratch);
}

void read_wean(std::span<const Source> sources, Log& log) {
  std::vector<float> scratch;
  for_each_record(sources.front(), ' ', kScanFields, log, [&](const Tokens& t, std::size_t) {
    if (t[0] == "L") {
      read_scan(t, log, scratch);
    } else {
      if (t[0] == "O") expect_fields(t.size(), kOdometryFields);
      log.skip(t[0]);
    }
  });
}

}  // namespace

const Format kWean{
    "wean",   "laser with odometry, CMU 16-831: lines L (scan) and O (odometry)", looks_like_wean, nullptr, nullptr, 1,
    read_wean};

}  // namespace evigrid::driver
