// SPDX-License-Identifier: Apache-2.0
// CARMEN text logs. One record per line, keyword first:
//   FLASER|RLASER n r1..rn x y theta odom_x odom_y odom_theta ipc_time host logger_time
//   ROBOTLASER1|2 type start_rad fov_rad step_rad max_range_m accuracy remission_mode n r1..rn m i1..im
//                 laser_x laser_y laser_theta robot_x robot_y robot_theta tv rv forward side turn_axis ipc_time host
//                 time
// Metres, radians counter-clockwise; the pose is the laser's own, so the mount is the identity.
// Beam 0 of FLASER and RLASER looks to −90°; the step is 1° for 180 or 181 beams, 0.5° for 360 or 361, else 180°/n.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "log/fields.hpp"
#include "log/formats.hpp"

namespace evigrid::driver {
namespace {

constexpr double kMaxBeams = 1e6;
constexpr std::size_t kHead = 2, kPoses = 6, kTail = 3;  // FLASER n; two poses; ipc_time host logger_time

/// A count field: a whole number within reason.
std::size_t count(const Tokens& tokens, std::size_t at, double least) {
  const double value = number(tokens, at);
  if (!(value >= least && value <= kMaxBeams) || value != std::floor(value)) {
    throw Malformed{"wrong count",
                    fmt::format("field {}: '{}' is no number of beams", at + 1, tokens[at].substr(0, 24))};
  }
  return static_cast<std::size_t>(value);
}

void expect_fields(std::size_t got, std::size_t wanted, std::size_t beams) {
  if (got == wanted) return;
  throw Malformed{got < wanted ? "too short" : "wrong count",
                  fmt::format("{} fields, {} beams need {}", got, beams, wanted)};
}

double flaser_step_rad(std::size_t n) {
  if (n == 180 || n == 181) return 1.0 * kDeg;
  if (n == 360 || n == 361) return 0.5 * kDeg;
  return 180.0 * kDeg / static_cast<double>(n);
}

Sensor fan(std::size_t beams, double first_rad, double step_rad) {
  Sensor s;
  s.model = Model::beam;
  s.beams = static_cast<int>(beams);
  s.first_beam_rad = first_rad;
  s.beam_step_rad = step_rad;
  s.min_range_m = 0.05;
  s.max_range_m = 10.0;
  return s;
}

/// A geometry that the engine could never take makes the record useless, not the log.
void require_usable(const Sensor& sensor) {
  if (const auto errors = check(sensor); !errors.empty()) {
    throw Malformed{"unusable geometry", errors.front().field + " " + errors.front().reason};
  }
}

void ranges(const Tokens& t, std::size_t first, std::size_t n, Log& log, std::vector<float>& out) {
  out.clear();
  for (std::size_t i = 0; i < n; ++i) out.push_back(range_m(number(t, first + i), log));
}

void read_flaser(const Tokens& t, Log& log, std::vector<float>& scratch) {
  if (t.size() < kHead) throw Malformed{"too short", "no number of beams"};
  const std::size_t n = count(t, 1, 2);
  expect_fields(t.size(), kHead + n + kPoses + kTail, n);
  const std::size_t p = kHead + n;
  const Pose2 pose{number(t, p), number(t, p + 1), number(t, p + 2)};
  const std::int64_t stamp = stamp_ns(number(t, p + kPoses));
  const Sensor sensor = fan(n, -90 * kDeg, flaser_step_rad(n));
  require_usable(sensor);
  ranges(t, kHead, n, log, scratch);
  append_fan(log, sensor_index(log, t[0], sensor), stamp, pose, scratch);
}

void read_robotlaser(const Tokens& t, Log& log, std::vector<float>& scratch) {
  constexpr std::size_t kCount = 8, kAfterPoses = 5;
  if (t.size() <= kCount) throw Malformed{"too short", fmt::format("{} fields", t.size())};
  const std::size_t n = count(t, kCount, 2);
  if (t.size() <= kCount + 1 + n) throw Malformed{"too short", fmt::format("{} fields, {} beams", t.size(), n)};
  const std::size_t remissions = count(t, kCount + 1 + n, 0);
  const std::size_t p = kCount + 2 + n + remissions;
  expect_fields(t.size(), p + kPoses + kAfterPoses + kTail, n);
  double first_rad = number(t, 2), step_rad = number(t, 4);
  const bool clockwise = step_rad < 0;
  if (clockwise) {  // counted from the other end
    first_rad += step_rad * static_cast<double>(n - 1);
    step_rad = -step_rad;
  }
  Sensor sensor = fan(n, first_rad, step_rad);
  if (const double stated_m = number(t, 5); stated_m > 1 && stated_m < sensor.no_return_m)
    sensor.no_return_m = stated_m;
  require_usable(sensor);
  const Pose2 pose{number(t, p), number(t, p + 1), number(t, p + 2)};
  const std::int64_t stamp = stamp_ns(number(t, p + kPoses + kAfterPoses));
  ranges(t, kCount + 1, n, log, scratch);
  if (clockwise) std::reverse(scratch.begin(), scratch.end());
  append_fan(log, sensor_index(log, t[0], sensor), stamp, pose, scratch);
}

bool looks_like_carmen(const FirstLine& line) {
  static constexpr std::string_view kKeywords[] = {"FLASER", "RLASER", "ROBOTLASER1", "ROBOTLASER2", "ODOM",
                                                   "PARAM",  "NEFF",   "TRUEPOS",     "SYNC",        "RAWLASER1"};
  return std::find(std::begin(kKeywords), std::end(kKeywords), line.blanks[0]) != std::end(kKeywords);
}

void read_carmen_file(const Source& source, Log& log) {
  std::vector<float> scratch;
  for_each_record(source, ' ', kMostFields, log, [&](const Tokens& tokens, std::size_t) {
    try {
      if (tokens[0] == "FLASER" || tokens[0] == "RLASER") {
        read_flaser(tokens, log, scratch);
      } else if (tokens[0] == "ROBOTLASER1" || tokens[0] == "ROBOTLASER2") {
        read_robotlaser(tokens, log, scratch);
      } else {
        log.skip(tokens[0]);  // ODOM too: the poses of the scans are what a map needs
      }
    } catch (const Malformed& bad) {
      throw Malformed{bad.reason, fmt::format("{}: {}", tokens[0], bad.detail)};
    }
  });
}

// Loggers write "no return" as the scanner's largest number (81.83, 81.91, 50, 32.767 ...), and some as several codes
// a few centimetres apart (81.91, 81.89, 81.87: error codes). So: the values within 5 cm of a log's largest are that
// code when there are at least two of them and they lie beyond 20 m, where indoor scanners no longer measure; a log
// whose largest value stands alone or is nearer just measured it.
void find_no_return(Log& log) {
  constexpr float kLeast_m = 20.0F, kPlateau_m = 0.05F;
  for (std::size_t sensor = 0; sensor < log.sensors.size(); ++sensor) {
    Sensor& s = log.sensors[sensor].sensor;
    if (s.beams < 2) continue;
    std::vector<std::span<const float>> mine;
    for (const LogReading& r : log.readings) {
      if (r.sensor == sensor) mine.emplace_back(log.ranges_m.data() + r.first, r.count);
    }
    float largest_m = 0;
    for (const auto beams : mine) {
      for (const float range_m : beams) {
        if (std::isfinite(range_m)) largest_m = std::max(largest_m, range_m);
      }
    }
    std::size_t close = 0;
    for (const auto beams : mine) {
      close += static_cast<std::size_t>(std::count_if(
          beams.begin(), beams.end(), [&](float r) { return std::isfinite(r) && r >= largest_m - kPlateau_m; }));
    }
    if (largest_m >= kLeast_m && close >= 2) {
      s.no_return_m = std::min(s.no_return_m, static_cast<double>(largest_m - kPlateau_m));
    }
  }
}

void read_carmen(std::span<const Source> sources, Log& log) {
  for (const Source& source : sources) read_carmen_file(source, log);
  find_no_return(log);
}

}  // namespace

const Format kCarmen{
    "carmen",   "CARMEN text log (FLASER, RLASER, ROBOTLASER1 and 2)", looks_like_carmen, nullptr, nullptr, 4096,
    read_carmen};

}  // namespace evigrid::driver
