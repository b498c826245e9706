// SPDX-License-Identifier: Apache-2.0
// The ring of eight sonars, published as two files of blank-separated integers:
//   poses.txt        t_ms x_mm y_mm theta_decidegrees (counter-clockwise)
//   measurement.txt  t_ms z0..z7 mm; 5110 = no echo
// A measurement belongs to the pose with its time stamp: normally the same line, otherwise wherever it is.
#include <fmt/format.h>

#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <unordered_map>

#include "log/line_reader.hpp"
#include "log/readers.hpp"

namespace evigrid::driver {
namespace {

constexpr double kDeg = std::numbers::pi / 180;
constexpr int kSonars = 8;
constexpr double kBearing_rad[kSonars] = {-90 * kDeg, -37.5 * kDeg, -22.5 * kDeg, -7.5 * kDeg,
                                          7.5 * kDeg, 22.5 * kDeg,  37.5 * kDeg,  90 * kDeg};
constexpr double kNoEcho_mm = 5110;

/// Reads rows of `width` numbers; calls row(line, values) for each good one and counts the others.
template <class Row>
void for_each_row(const std::string& path, std::size_t width, Log& log, Row row) {
  LineReader lines(path);
  std::string_view line;
  std::vector<std::string_view> tokens;
  std::vector<double> values(width);
  while (lines.next(line)) {
    split(line, tokens);
    if (tokens.empty()) continue;
    if (tokens[0].front() == '#') {
      log.skip("#");
      continue;
    }
    if (tokens.size() != width) {
      log.reject(path, lines.line_number(), tokens.size() < width ? "too short" : "wrong count",
                 fmt::format("{} fields, need {}", tokens.size(), width));
      continue;
    }
    std::size_t at = 0;
    while (at < width && parse_number(tokens[at], values[at])) ++at;
    if (at < width || !(std::abs(values[0]) < 9e12)) {
      at = at < width ? at : 0;
      log.reject(path, lines.line_number(), "bad number",
                 fmt::format("field {} is '{}'", at + 1, tokens[at].substr(0, 24)));
      continue;
    }
    row(lines.line_number(), values);
  }
}

void add_sonars(Log& log) {
  for (const double bearing_rad : kBearing_rad) {
    Sensor s;
    s.model = Model::li2014;
    s.T_robot_sensor = {0, 0, bearing_rad};
    s.aperture_rad = 20 * kDeg;
    s.min_range_m = 0.17;
    s.max_range_m = 5.0;
    s.no_return_m = kNoEcho_mm / 1000;
    log.sensors.push_back({"sonar", s});
  }
}

float range_m(double mm, Log& log) {
  if (mm == kNoEcho_mm) return std::numeric_limits<float>::infinity();
  if (std::isfinite(mm) && mm / 1000 > kAbsurdRange_m) {
    ++log.absurd_ranges;
    return std::numeric_limits<float>::quiet_NaN();
  }
  return static_cast<float>(mm / 1000);
}

}  // namespace

void read_ring8(const std::string& poses_path, const std::string& measurements_path, Log& log) {
  std::unordered_map<std::int64_t, std::deque<Pose2>> poses;  // a stamp may occur twice: first come, first served
  std::size_t pose_rows = 0;
  for_each_row(poses_path, 4, log, [&](std::size_t, const std::vector<double>& v) {
    poses[std::llround(v[0])].push_back({v[1] / 1000, v[2] / 1000, v[3] / 10 * kDeg});
    ++pose_rows;
  });
  add_sonars(log);
  std::size_t matched = 0;
  for_each_row(measurements_path, 1 + kSonars, log, [&](std::size_t line, const std::vector<double>& v) {
    const std::int64_t stamp_ms = std::llround(v[0]);
    const auto found = poses.find(stamp_ms);
    if (found == poses.end() || found->second.empty()) {
      log.reject(measurements_path, line, "no pose", fmt::format("no pose has the time stamp {}", stamp_ms));
      return;
    }
    log.scans.push_back({stamp_ms * 1'000'000, found->second.front(), log.readings.size(), kSonars});
    found->second.pop_front();
    for (std::size_t i = 0; i < kSonars; ++i) {
      log.readings.push_back({i, log.ranges_m.size(), 1});
      log.ranges_m.push_back(range_m(v[1 + i], log));
    }
    ++matched;
  });
  if (pose_rows > matched) log.malformed["no measurement"] += pose_rows - matched;
}

}  // namespace evigrid::driver
