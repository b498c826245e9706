// SPDX-License-Identifier: Apache-2.0
// The ring of 24 sonars of a SCITOS G5 robot (UCI repository, "wall-following robot navigation"), without any pose:
//   S1,…,S24,OUTPUT     metres; the last column is a word: what the robot was to do
// S1 looks ahead, the others follow clockwise by 15°; 5.000 = no echo. The published variants with 4 and 2 columns hold
// the least range of arcs of 60°, which is no reading of any sensor: refused. The source gives no aperture and no
// radius: each cone gets the ring's own 15° and starts at the robot's centre. Nine scans a second, says the source.
#include <cmath>

#include "log/formats.hpp"
#include "log/table.hpp"

namespace evigrid::driver {
namespace {

constexpr std::size_t kSensors = 24, kFields = kSensors + 1;
constexpr double kPeriod_s = 1.0 / 9, kNoEcho_m = 5.0, kRounding_m = 0.0005;

bool is_number(std::string_view token) {
  double ignored = 0;
  return parse_number(token, ignored);
}

/// A row: numbers and a word at the end.
bool row_of(const Tokens& t, std::size_t numbers) {
  return t.size() == numbers + 1 && std::all_of(t.begin(), t.end() - 1, is_number) && !is_number(t.back()) &&
         t.back().find('-') != std::string_view::npos;
}

bool simplified(const Tokens& t) { return row_of(t, 4) || row_of(t, 2) || (t.size() > 1 && t[0] == "SD_front"); }

bool looks_like_uci24(const FirstLine& line) {
  return (line.commas.size() == kFields && line.commas[0] == "S1") || row_of(line.commas, kSensors) ||
         simplified(line.commas);
}

void add_sensors(Log& log) {
  Sensor s;
  s.model = Model::li2014;
  s.aperture_rad = 15 * kDeg;
  s.min_range_m = 0.2;
  s.max_range_m = kNoEcho_m;
  s.no_return_m = kNoEcho_m - kRounding_m;
  for (std::size_t k = 0; k < kSensors; ++k) {
    s.T_robot_sensor = {0, 0, -15.0 * static_cast<double>(k) * kDeg};
    log.sensors.push_back({"sonar", s, fmt::format("S{}", k + 1)});
  }
}

void read_uci24(std::span<const Source> sources, Log& log) {
  log.poses = Poses::none;
  log.nominal_period_s = kPeriod_s;
  add_sensors(log);
  std::vector<float> ranges(kSensors);
  for_each_record(sources.front(), ',', kFields, log, [&](const Tokens& t, std::size_t line) {
    if (simplified(t)) {
      throw InputError(
          fmt::format("{}:{}: {} columns: the simplified variant holds the least range of arcs of 60°, which is no "
                      "reading of a sensor; the file with 24 can be read",
                      sources.front().name, line, t.size() - 1));
    }
    if (t[0] == "S1" && t.size() == kFields) return;  // the head line
    expect_fields(t.size(), kFields);
    for (std::size_t k = 0; k < kSensors; ++k) ranges[k] = range_m(number(t, k), log);
    append_cones(log, 0, stamp_ns(static_cast<double>(log.scans.size()) * kPeriod_s), {}, ranges);
  });
}

}  // namespace

const Format kUci24{
    "uci24",          "ring of 24 sonars without poses, UCI wall-following: S1,..,S24,OUTPUT; needs --scans",
    looks_like_uci24, nullptr,
    nullptr,          1,
    read_uci24};

}  // namespace evigrid::driver
