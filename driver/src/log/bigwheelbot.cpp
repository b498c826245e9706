// SPDX-License-Identifier: Apache-2.0
// The Big Wheel Bot (Big Face Robotics): two sonars, two infrared range finders, wheel encoders and a yaw, no time:
//   LeftEnc,RightEnc,Yaw,FrontSonar,RearSonar,LeftIR,RightIR,Servo1,Servo2
// Encoders: ticks of 5 mm since the last line. Yaw: degrees clockwise, of the robot, absolute; ours is its negative.
// Sonars: cm at 0° and 180°, ±15°, ≥ 520 = no echo. Infrared: cm, left at +45° and right at −45° (the source counts
// them in an image, y downwards); 60 = nothing there, 0 = a dropout. Servos are not used. The line's readings are
// placed where the robot stood before the line's own increment, with the line's own yaw: with the yaw of the line
// before or after it the sonar's echoes spread over up to 7 % more cells. The position starts at the origin and drifts
// (dead reckoning).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "log/fields.hpp"
#include "log/formats.hpp"

namespace evigrid::driver {
namespace {

constexpr std::size_t kFields = 9;
constexpr double kTick_m = 0.005, kCm = 0.01, kNoEcho_cm = 520, kIrNothing_cm = 60;
constexpr double kMostStep_m = 2;         // in one line: more is a broken counter
constexpr double kPeriod_s = 0.1;         // nominal: the log holds no time, and nothing depends on it but the stamps
constexpr double kIrCone_rad = 5 * kDeg;  // ours: an infrared spot is narrow, and the engine's cones are not rays

bool looks_like_bigwheelbot(const FirstLine& line) {
  double ignored = 0;
  return line.commas.size() == kFields && std::all_of(line.commas.begin(), line.commas.end(),
                                                      [&](std::string_view t) { return parse_number(t, ignored); });
}

void add_sensors(Log& log) {
  Sensor sonar;
  sonar.model = Model::li2014;
  sonar.aperture_rad = 30 * kDeg;
  sonar.min_range_m = 0.02;
  sonar.max_range_m = kNoEcho_cm * kCm;
  sonar.no_return_m = (kNoEcho_cm - 0.5) * kCm;  // whole centimetres: half of one is safe from rounding to float
  for (const auto& [bearing_deg, name] : {std::pair{0, "front"}, {180, "rear"}}) {
    sonar.T_robot_sensor = {0, 0, bearing_deg * kDeg};
    log.sensors.push_back({"sonar", sonar, name});
  }
  Sensor ir = sonar;
  ir.aperture_rad = kIrCone_rad;
  ir.max_range_m = kIrNothing_cm * kCm;
  ir.no_return_m = (kIrNothing_cm - 0.5) * kCm;
  for (const auto& [bearing_deg, name] : {std::pair{45, "left"}, {-45, "right"}}) {
    ir.T_robot_sensor = {0, 0, bearing_deg * kDeg};
    log.sensors.push_back({"ir", ir, name});
  }
}

float ir_m(double cm, Log& log) {
  if (cm != 0) return range_m(cm * kCm, log);
  ++log.facts["ir_dropouts"];
  return std::numeric_limits<float>::quiet_NaN();
}

void read_bigwheelbot(std::span<const Source> sources, Log& log) {
  log.poses = Poses::dead_reckoned;
  log.nominal_period_s = kPeriod_s;
  add_sensors(log);
  double x_m = 0, y_m = 0;
  std::vector<float> ranges(4);
  for_each_record(sources.front(), ',', kFields, log, [&](const Tokens& t, std::size_t) {
    expect_fields(t.size(), kFields);
    const double step_m = (finite_number(t, 0) + finite_number(t, 1)) / 2 * kTick_m;
    const double yaw_rad = -std::remainder(finite_number(t, 2), 360) * kDeg;
    if (!(std::abs(step_m) <= kMostStep_m)) {
      throw Malformed{"absurd step", fmt::format("the wheels went {:g} m at once", step_m)};
    }
    const double values[] = {number(t, 3), number(t, 4), number(t, 5), number(t, 6)};
    for (std::size_t i = 0; i < 2; ++i) ranges[i] = range_m(values[i] * kCm, log);
    for (std::size_t i = 2; i < 4; ++i) ranges[i] = ir_m(values[i], log);
    append_cones(log, 0, stamp_ns(static_cast<double>(log.scans.size()) * kPeriod_s), {x_m, y_m, yaw_rad}, ranges);
    x_m += step_m * std::cos(yaw_rad);
    y_m += step_m * std::sin(yaw_rad);
  });
}

}  // namespace

const Format kBigWheelBot{"bigwheelbot",
                          "two sonars, two infrared, encoders and yaw: nine numbers, comma-separated",
                          looks_like_bigwheelbot,
                          nullptr,
                          nullptr,
                          1,
                          read_bigwheelbot};

}  // namespace evigrid::driver
