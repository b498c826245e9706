// SPDX-License-Identifier: Apache-2.0
// A simulated ring of twelve range finders with poses, CSV with a head line, no time:
//   x,y,heading_angle_degrees,sensor_0,…,sensor_11
// Metres, degrees counter-clockwise; sensor k looks to heading + 30°·k; an empty field is "no target" = no echo.
// What the published file shows beyond that: the ranges are those of a ray along the axis (96 % of the readings on the
// outer walls within 0.1 m; only 60 % for a cone of 10°) with noise of about 0.05 m, and two fifths of them lie in a
// heap at 3.5 ± 0.2 m in the open: the simulator's own limit with noise on it. So: narrow cones, and from 3.3 m on a
// reading is no echo.
#include <cmath>
#include <limits>

#include "log/formats.hpp"
#include "log/table.hpp"

namespace evigrid::driver {
namespace {

constexpr std::size_t kSensors = 12, kFields = 3 + kSensors;
constexpr double kPeriod_s = 0.1;  // nominal: the log holds no time
constexpr double kLimit_m = 3.3;

bool looks_like_roomba12(const FirstLine& line) {
  return line.commas.size() > 3 && line.commas[2] == "heading_angle_degrees" && line.commas[3] == "sensor_0";
}

void add_sensors(Log& log) {
  Sensor s;
  s.model = Model::li2014;
  s.aperture_rad = 5 * kDeg;
  s.min_range_m = 0.1;
  s.max_range_m = kLimit_m;
  s.no_return_m = kLimit_m;
  for (std::size_t k = 0; k < kSensors; ++k) {
    s.T_robot_sensor = {0, 0, static_cast<double>(k) * 30 * kDeg};
    log.sensors.push_back({"sonar", s, fmt::format("sensor_{}", k)});
  }
}

void read_roomba12(std::span<const Source> sources, Log& log) {
  log.nominal_period_s = kPeriod_s;
  add_sensors(log);
  std::vector<float> ranges(kSensors);
  const auto head = [](const Tokens& t, const std::string& where) {
    std::vector<std::string> names{"x", "y", "heading_angle_degrees"};
    for (std::size_t k = 0; k < kSensors; ++k) names.push_back(fmt::format("sensor_{}", k));
    for (std::size_t at = 0; at < names.size(); ++at) {
      if (required_column(t, names[at], where) != at)
        throw InputError(fmt::format("{}:{}: is not column {}", where, names[at], at + 1));
    }
  };
  for_each_table_row(sources.front(), kFields, log, head, [&](const Tokens& t, std::size_t) {
    expect_fields(t.size(), kFields);
    const Pose2 pose{number(t, 0), number(t, 1), number(t, 2) * kDeg};
    for (std::size_t k = 0; k < kSensors; ++k) {
      const bool no_target = t[3 + k].empty();
      ranges[k] = no_target ? std::numeric_limits<float>::infinity() : range_m(number(t, 3 + k), log);
    }
    append_cones(log, 0, stamp_ns(static_cast<double>(log.scans.size()) * kPeriod_s), pose, ranges);
  });
}

}  // namespace

const Format kRoomba12{"roomba12",
                       "simulated ring of twelve with poses: CSV x,y,heading_angle_degrees,sensor_0..11",
                       looks_like_roomba12,
                       nullptr,
                       nullptr,
                       1,
                       read_roomba12};

}  // namespace evigrid::driver
