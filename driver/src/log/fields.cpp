// SPDX-License-Identifier: Apache-2.0
#include "log/fields.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace evigrid::driver {
namespace {

constexpr std::size_t kShown = 24;         // characters of a bad field that a message repeats
constexpr std::size_t kMostSensors = 256;  // geometries of one log: a robot has a few, a broken file any number
constexpr double kMostSeconds = 4.5e9;     // of two the difference in nanoseconds fits 63 bits

}  // namespace

double number(const Tokens& tokens, std::size_t at) {
  double value = 0;
  if (!parse_number(tokens[at], value)) {
    throw Malformed{"bad number", fmt::format("field {} is '{}'", at + 1, printable(tokens[at].substr(0, kShown)))};
  }
  return value;
}

double finite_number(const Tokens& tokens, std::size_t at) {
  const double value = number(tokens, at);
  if (!std::isfinite(value)) throw Malformed{"bad number", fmt::format("field {} is not finite", at + 1)};
  return value;
}

void expect_fields(std::size_t got, std::size_t wanted) {
  if (got == wanted) return;
  throw Malformed{got < wanted ? "too short" : "wrong count", fmt::format("{} fields, need {}", got, wanted)};
}

std::int64_t stamp_ns(double seconds) {
  if (!(std::abs(seconds) < kMostSeconds)) throw Malformed{"bad number", "the time stamp is no time"};
  return std::llround(seconds * 1e9);
}

float range_m(double metres, Log& log) {
  if (std::isfinite(metres) && metres > kAbsurdRange_m) {
    ++log.absurd_ranges;
    return std::numeric_limits<float>::quiet_NaN();
  }
  return static_cast<float>(metres);
}

std::size_t sensor_index(Log& log, std::string_view kind, const Sensor& wanted) {
  for (std::size_t i = 0; i < log.sensors.size(); ++i) {
    const Sensor& s = log.sensors[i].sensor;
    if (log.sensors[i].kind == kind && s.beams == wanted.beams && s.first_beam_rad == wanted.first_beam_rad &&
        s.beam_step_rad == wanted.beam_step_rad && s.no_return_m == wanted.no_return_m) {
      return i;
    }
  }
  if (log.sensors.size() >= kMostSensors) {
    throw Malformed{"too many sensors", fmt::format("over {} different geometries", kMostSensors)};
  }
  log.sensors.push_back({std::string(kind), wanted});
  return log.sensors.size() - 1;
}

void append_fan(Log& log, std::size_t sensor, std::int64_t stamp, const Pose2& pose,
                const std::vector<float>& ranges_m) {
  log.scans.push_back({stamp, pose, log.readings.size(), 1});
  log.readings.push_back({sensor, log.ranges_m.size(), ranges_m.size()});
  log.ranges_m.insert(log.ranges_m.end(), ranges_m.begin(), ranges_m.end());
}

void append_cones(Log& log, std::size_t first_sensor, std::int64_t stamp, const Pose2& pose,
                  const std::vector<float>& ranges_m) {
  log.scans.push_back({stamp, pose, log.readings.size(), ranges_m.size()});
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    log.readings.push_back({first_sensor + i, log.ranges_m.size(), 1});
    log.ranges_m.push_back(ranges_m[i]);
  }
}

}  // namespace evigrid::driver
