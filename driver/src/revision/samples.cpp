// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "error.hpp"
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

bool is_cast(const std::string& path) {
  LineReader lines(path);
  std::string_view first;
  return lines.next(first) && first.starts_with("step,stamp_ns,");
}

std::vector<std::vector<Sample>> read_cast(const std::string& path) {
  std::vector<std::vector<Sample>> out;
  Log counts;
  std::size_t width = 0, sensor_at = 0, range_at = 0, truth_at = 0;
  const auto head = [&](const Tokens& t, const std::string& where) {
    width = t.size();
    sensor_at = required_column(t, "sensor", where);
    range_at = required_column(t, "range_m", where);
    truth_at = required_column(t, "truth", where);
  };
  for_each_table_row(Source{path}, kMostCastFields, counts, head, [&](const Tokens& t, std::size_t) {
    expect_fields(t.size(), width);
    const double sensor = finite_number(t, sensor_at);
    if (!(sensor >= 0 && sensor < kMostSensors)) throw InputError(path + ": sensor: no number of a sensor");
    add(out, static_cast<std::size_t>(sensor), number(t, truth_at), number(t, range_at));
  });
  if (counts.malformed_total() > 0) {
    throw InputError(counts.warnings.empty() ? path + ": has lines that cannot be read" : counts.warnings.front());
  }
  return out;
}

}  // namespace

std::vector<std::vector<Sample>> read_samples(const std::string& path) {
  if (is_cast(path)) return read_cast(path);
  const Log log = read_log({path}, "auto");
  if (log.truth_m.empty()) throw InputError(path + ": holds no true ranges; `evigrid cast --truth` writes some");
  std::vector<std::vector<Sample>> out(log.sensors.size());
  for (const LogReading& r : log.readings) {
    for (std::size_t i = r.first; i < r.first + r.count; ++i) {
      const double range_m = static_cast<double>(log.ranges_m[i]);
      if (range_m < log.sensors[r.sensor].sensor.no_return_m)
        add(out, r.sensor, static_cast<double>(log.truth_m[i]), range_m);
    }
  }
  return out;
}

}  // namespace evigrid::driver
