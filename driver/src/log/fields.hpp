// SPDX-License-Identifier: Apache-2.0
// Fields of a record, strictly: what every reader asks of its tokens. A bad field throws Malformed, which the reader
// counts by reason and reports with file and line; it never ends the reading of a log.
#pragma once
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "log/log.hpp"
#include "log/source.hpp"

namespace evigrid::driver {

inline constexpr double kDeg = std::numbers::pi / 180;

using Tokens = std::vector<std::string_view>;

/// Why a record cannot be used.
struct Malformed {
  const char* reason;
  std::string detail;
};

/// Field `at` (counted from 0 here, from 1 in messages) as a number; nan and inf are numbers.
double number(const Tokens& tokens, std::size_t at);

/// The same for what must be finite: increments, stamps.
double finite_number(const Tokens& tokens, std::size_t at);

/// Throws "too short" or "wrong count" unless there are exactly `wanted` fields.
void expect_fields(std::size_t got, std::size_t wanted);

/// Seconds (of any epoch, finite, below 4.5e9) as nanoseconds.
std::int64_t stamp_ns(double seconds);

/// A range in metres for the log; absurd ones become NaN and are counted.
float range_m(double metres, Log& log);

/// The sensor of that kind with that very geometry: found, or added.
std::size_t sensor_index(Log& log, std::string_view kind, const Sensor& wanted);

/// Appends a scan that is one reading of one fan.
void append_fan(Log& log, std::size_t sensor, std::int64_t stamp, const Pose2& T_map_robot,
                const std::vector<float>& ranges_m);

/// Appends a scan with one range of each sensor [first_sensor, first_sensor + ranges_m.size()).
void append_cones(Log& log, std::size_t first_sensor, std::int64_t stamp, const Pose2& T_map_robot,
                  const std::vector<float>& ranges_m);

/// Calls row(tokens, line number) for every line that is neither empty nor a '#' comment (counted); Malformed thrown
/// by it is counted and reported.
template <class Row>
void for_each_record(const Source& source, char separator, std::size_t most_fields, Log& log, Row row);

}  // namespace evigrid::driver

#include "log/fields.inl.hpp"
