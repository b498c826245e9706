// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "error.hpp"
#include "log/named_sources.hpp"
#include "log/readers.hpp"
#include "log/table.hpp"
#include "revision/train.hpp"

namespace evigrid::driver {
namespace {

constexpr std::size_t kMostSensors = 65536, kMostCastFields = 64;

void add(std::vector<std::vector<Sample>>& out, std::size_t sensor, double truth_m, double reading_m) {
  if (sensor >= out.size()) out.resize(sensor + 1);
  if (std::isfinite(truth_m) && std::isfinite(reading_m)) out[sensor].push_back({truth_m, reading_m});
}

bool is_cast(const Source& source) {
  LineReader lines(source);
  std::string_view first;
  return lines.next(first) && first.starts_with("step,stamp_ns,");
}

Samples read_cast(const Source& source) {
  Samples out;
  Log counts;
  std::size_t width = 0, sensor_at = 0, range_at = 0, truth_at = 0;
  const auto head = [&](const Tokens& t, const std::string& where) {
    width = t.size();
    sensor_at = required_column(t, "sensor", where);
    range_at = required_column(t, "range_m", where);
    truth_at = required_column(t, "truth", where);
  };
  for_each_table_row(source, kMostCastFields, counts, head, [&](const Tokens& t, std::size_t) {
    expect_fields(t.size(), width);
    const double sensor = finite_number(t, sensor_at);
    if (!(sensor >= 0 && sensor < kMostSensors) || sensor != std::floor(sensor))
      throw Malformed{"unknown sensor", fmt::format("{} is no number of a sensor", sensor)};
    add(out.by_sensor, static_cast<std::size_t>(sensor), number(t, truth_at), number(t, range_at));
  });
  out.malformed = counts.malformed;
  out.warnings = counts.warnings;
  return out;
}

}  // namespace

Samples read_samples(const std::string& path) {
  const NamedSources named(std::span(&path, 1));
  const Source& source = named.all().front();
  if (is_cast(source)) return read_cast(source);
  const Log log = read_text_log(named, "auto");
  if (log.truth_m.empty()) throw InputError(path + ": holds no true ranges; `evigrid cast --truth` writes some");
  Samples out{std::vector<std::vector<Sample>>(log.sensors.size()), log.malformed, log.warnings};
  for (const LogReading& r : log.readings) {
    for (std::size_t i = r.first; i < r.first + r.count; ++i) {
      const double range_m = static_cast<double>(log.ranges_m[i]);
      if (range_m < log.sensors[r.sensor].sensor.no_return_m)
        add(out.by_sensor, r.sensor, static_cast<double>(log.truth_m[i]), range_m);
    }
  }
  return out;
}

}  // namespace evigrid::driver
