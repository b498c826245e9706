// SPDX-License-Identifier: Apache-2.0
// Range finders on a robot that drives towards and away from a wall, with the true range beside them (ENMT482
// coursework, University of Canterbury), CSV with a head line:
//   ,time,range,velocity_command,raw_ir1,…,raw_ir4,sonar1,sonar2
// Seconds, metres; `range` is the truth. sonar1 and sonar2 are ranges; 8.0 and 5.0 are the largest they can say = no
// echo. raw_ir1..4 are volts whose curve the source does not give: left out. For `calibrate`, not for a map.
#include <cmath>

#include "log/formats.hpp"
#include "log/table.hpp"

namespace evigrid::driver {
namespace {

constexpr std::size_t kMostFields482 = 64;

struct Column {
  const char* name;
  double min_range_m, no_echo_m;
};
constexpr Column kRanges[] = {{"sonar1", 0.02, 8.0}, {"sonar2", 0.3, 5.0}};
constexpr double kRounding_m = 0.0005;

bool looks_like_enmt482(const FirstLine& line) {
  return line.commas.size() > 3 && line.commas[1] == "time" && line.commas[2] == "range" &&
         line.commas[3] == "velocity_command";
}

void add_sensors(Log& log) {
  for (const Column& c : kRanges) {
    Sensor s;
    s.model = Model::li2014;
    s.min_range_m = c.min_range_m;
    s.max_range_m = c.no_echo_m;
    s.no_return_m = c.no_echo_m - kRounding_m;
    log.sensors.push_back({"sonar", s, c.name});
  }
}

void read_enmt482(std::span<const Source> sources, Log& log) {
  log.poses = Poses::one_dimension;
  add_sensors(log);
  std::size_t width = 0, time_at = 0, truth_at = 0;
  std::vector<std::size_t> at;
  const auto head = [&](const Tokens& t, const std::string& where) {
    width = t.size();
    time_at = required_column(t, "time", where);
    truth_at = required_column(t, "range", where);
    for (const Column& c : kRanges) at.push_back(required_column(t, c.name, where));
  };
  std::vector<float> ranges(std::size(kRanges));
  for_each_table_row(sources.front(), kMostFields482, log, head, [&](const Tokens& t, std::size_t) {
    expect_fields(t.size(), width);
    const std::int64_t stamp = stamp_ns(number(t, time_at));
    const double truth_m = finite_number(t, truth_at);
    for (std::size_t k = 0; k < at.size(); ++k) ranges[k] = range_m(number(t, at[k]), log);
    append_cones(log, 0, stamp, {}, ranges);
    log.truth_m.insert(log.truth_m.end(), ranges.size(), static_cast<float>(truth_m));
  });
}

}  // namespace

const Format kEnmt482{"enmt482",
                      "range finders beside the true range: CSV time,range,velocity_command,..; for calibrate",
                      looks_like_enmt482,
                      nullptr,
                      nullptr,
                      1,
                      read_enmt482};

}  // namespace evigrid::driver
