// SPDX-License-Identifier: Apache-2.0
// A recorded log in memory, whatever its format: the sensors met, the scans in line order, and what was left out and
// why. Ranges in metres lie in one array; scans and readings refer to it by position, so a long log costs no small
// allocations. Readers only read: gates, models and limits are the engine's business.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "evigrid/sensor.hpp"
#include "evigrid/types.hpp"

namespace evigrid::driver {

struct LogSensor {
  std::string kind;       ///< "FLASER", "ROBOTLASER1", "sonar", "ir" ...
  Sensor sensor;          ///< geometry and limits as the log states them; the command adds model and reliability
  std::string name = {};  ///< as the log calls it ("sonar2"); empty: its number says enough
  bool stated = false;    ///< a scene says what the sensor is: its reliability is meant, even if it is 1
};

struct LogReading {
  std::size_t sensor = 0;            ///< index into Log::sensors
  std::size_t first = 0, count = 0;  ///< ranges [first, first + count) of Log::ranges_m
};

struct LogScan {
  std::int64_t stamp_ns = 0;
  Pose2 T_map_robot{};
  std::size_t first = 0, count = 0;  ///< readings [first, first + count) of Log::readings
};

/// Where the poses of a log come from, which says what can be done with it.
enum class Poses : std::uint8_t {
  recorded,       ///< every scan came with its pose
  dead_reckoned,  ///< summed up from wheels (and a compass) by the reader: drifts
  none,           ///< the robot stands at the origin; scans fit together only where it did stand still
  one_dimension   ///< a drive along a line with the true range: for `calibrate`, not for a map
};
std::string_view name(Poses);

struct Log {
  std::string format;  ///< "carmen", "ring8" ...; formats.cpp lists them
  std::vector<LogSensor> sensors;
  std::vector<LogScan> scans;
  std::vector<LogReading> readings;
  std::vector<float> ranges_m;
  std::vector<float> truth_m;  ///< the true range of each of them where the log knows it, else empty
  Poses poses = Poses::recorded;
  double nominal_period_s = 0;                     ///< above 0: the log has no time; stamp = scan number × this
  std::map<std::string, double> facts;             ///< what the reader measured on the way, by name with unit
  std::map<std::string, std::uint64_t> skipped;    ///< records of no use to a map, by keyword
  std::map<std::string, std::uint64_t> malformed;  ///< records that could not be read, by reason
  std::vector<std::string> warnings;               ///< the first few of those, with file and line
  std::uint64_t absurd_ranges = 0;                 ///< readings above kAbsurdRange_m, turned into NaN

  [[nodiscard]] bool fans() const { return !sensors.empty() && sensors.front().sensor.beams > 1; }
  [[nodiscard]] std::uint64_t malformed_total() const;
  void skip(std::string_view keyword);
  void reject(std::string_view file, std::size_t line, std::string_view reason, std::string_view detail);
};

inline constexpr float kAbsurdRange_m = 1000.0F;  ///< no range finder on a robot sees farther: a broken number

/// Reports are JSON and terminals are fragile: everything but printable ASCII becomes '?'.
std::string printable(std::string_view text);

}  // namespace evigrid::driver
