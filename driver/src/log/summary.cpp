// SPDX-License-Identifier: Apache-2.0
// Shares and quantiles are of the ranges as logged; "in range" is what a map with the log's own limits would use.
#include "log/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace evigrid::driver {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kToDeg = 180 / std::numbers::pi;

double rounded(double value, double to) { return std::round(value / to) * to; }
double deg(double rad) { return rounded(rad * kToDeg, 1e-6) + 0.0; }

struct Ranges {
  std::vector<float> good;  ///< in range
  std::uint64_t all = 0, no_return = 0, not_a_number = 0, too_near = 0, too_far = 0;
};

Ranges ranges_of(const Log& log, std::size_t sensor) {
  const Sensor& s = log.sensors[sensor].sensor;
  Ranges out;
  for (const LogReading& r : log.readings) {
    if (r.sensor != sensor) continue;
    for (std::size_t i = r.first; i < r.first + r.count; ++i) {
      const float range_m = log.ranges_m[i];
      ++out.all;
      if (std::isnan(range_m)) {
        ++out.not_a_number;
      } else if (range_m >= s.no_return_m) {
        ++out.no_return;
      } else if (range_m < s.min_range_m) {
        ++out.too_near;
      } else if (range_m > s.max_range_m) {
        ++out.too_far;
      } else {
        out.good.push_back(range_m);
      }
    }
  }
  std::sort(out.good.begin(), out.good.end());
  return out;
}

Json quantiles(const std::vector<float>& sorted) {
  Json out = Json::array();
  if (sorted.empty()) return out;
  for (const double part : {0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0}) {
    const auto at = static_cast<std::size_t>(std::lround(part * static_cast<double>(sorted.size() - 1)));
    out.push_back(rounded(static_cast<double>(sorted[at]), 1e-4));
  }
  return out;
}

Json sensor_json(const Log& log, std::size_t i) {
  const LogSensor& ls = log.sensors[i];
  const Sensor& s = ls.sensor;
  const Ranges r = ranges_of(log, i);
  Json out;
  out["kind"] = ls.kind;
  out["name"] = ls.name.empty() ? fmt::format("{}", i) : ls.name;
  out["mount_m_deg"] = {s.T_robot_sensor.x_m, s.T_robot_sensor.y_m, deg(s.T_robot_sensor.yaw_rad)};
  if (s.beams > 1) {
    out["beams"] = s.beams;
    out["first_beam_deg"] = deg(s.first_beam_rad);
    out["beam_step_deg"] = deg(s.beam_step_rad);
  } else {
    out["aperture_deg"] = deg(s.aperture_rad);
  }
  out["min_range_m"] = s.min_range_m;
  out["max_range_m"] = s.max_range_m;
  out["no_return_m"] = s.no_return_m;
  out["ranges"] = r.all;
  out["in_range"] = r.good.size();
  out["no_return"] = r.no_return;
  out["too_near"] = r.too_near;
  out["too_far"] = r.too_far;
  out["not_a_number"] = r.not_a_number;
  out["range_quantiles_m"] = quantiles(r.good);
  return out;
}

Json extent(const Log& log) {
  double lo[2], hi[2], way_m = 0;
  std::fill_n(lo, 2, std::numeric_limits<double>::infinity());
  std::fill_n(hi, 2, -std::numeric_limits<double>::infinity());
  const Pose2* last = nullptr;
  std::uint64_t bad = 0;
  for (const LogScan& scan : log.scans) {
    const Pose2& p = scan.T_map_robot;
    if (!std::isfinite(p.x_m) || !std::isfinite(p.y_m) || !std::isfinite(p.yaw_rad)) {
      ++bad;
      continue;
    }
    const double xy[] = {p.x_m, p.y_m};
    for (int k = 0; k < 2; ++k) {
      lo[k] = std::min(lo[k], xy[k]);
      hi[k] = std::max(hi[k], xy[k]);
    }
    if (last != nullptr) way_m += std::hypot(p.x_m - last->x_m, p.y_m - last->y_m);
    last = &p;
  }
  Json out;
  if (last != nullptr) {
    out["x_m"] = {lo[0], hi[0]};
    out["y_m"] = {lo[1], hi[1]};
    out["way_m"] = way_m;
  }
  out["not_finite"] = bad;
  return out;
}

Json times(const Log& log) {
  Json out;
  std::int64_t lo = log.scans.front().stamp_ns, hi = lo, last = lo;
  std::uint64_t backwards = 0;
  for (const LogScan& scan : log.scans) {
    lo = std::min(lo, scan.stamp_ns);
    hi = std::max(hi, scan.stamp_ns);
    backwards += scan.stamp_ns < last ? 1 : 0;
    last = scan.stamp_ns;
  }
  out["first_s"] = static_cast<double>(lo) * 1e-9;
  out["span_s"] = static_cast<double>(hi - lo) * 1e-9;
  out["backwards"] = backwards;
  return out;
}

}  // namespace

Json log_origin(const Log& log) {
  Json out;
  out["poses"] = name(log.poses);
  out["stamps"] = log.nominal_period_s > 0
                      ? fmt::format("none: scan number times a nominal {:.3g} s", log.nominal_period_s)
                      : "recorded";
  if (!log.facts.empty()) out["log_facts"] = log.facts;
  return out;
}

Json summarise(const Log& log) {
  Json out;
  out["format"] = log.format;
  out["scans"] = log.scans.size();
  out.update(log_origin(log));
  out["time"] = times(log);
  out["extent"] = extent(log);
  out["true_ranges"] = !log.truth_m.empty();
  out["absurd_ranges"] = log.absurd_ranges;
  out["sensors"] = Json::array();
  for (std::size_t i = 0; i < log.sensors.size(); ++i) out["sensors"].push_back(sensor_json(log, i));
  out["records_skipped"] = log.skipped;
  out["records_malformed"] = log.malformed;
  out["warnings"] = log.warnings;
  return out;
}

std::string summary_text(const Json& s) {
  std::string out;
  const auto add = [&](const std::string& line) { out += line + "\n"; };
  add(fmt::format("format {}, {} scans; poses {}; stamps {}", s["format"].get<std::string>(),
                  s["scans"].get<std::size_t>(), s["poses"].get<std::string>(), s["stamps"].get<std::string>()));
  const Json& t = s["time"];
  add(fmt::format("time: {:.3f} s long, {} backwards", t["span_s"].get<double>(), t["backwards"].get<int>()));
  if (const Json& e = s["extent"]; e.contains("x_m")) {
    add(fmt::format("robot: x {:.2f} .. {:.2f} m, y {:.2f} .. {:.2f} m, way {:.1f} m", e["x_m"][0].get<double>(),
                    e["x_m"][1].get<double>(), e["y_m"][0].get<double>(), e["y_m"][1].get<double>(),
                    e["way_m"].get<double>()));
  }
  if (const auto n = s["extent"]["not_finite"].get<std::uint64_t>(); n > 0) add(fmt::format("poses not finite: {}", n));
  if (s.contains("log_facts")) {
    for (const auto& [key, value] : s["log_facts"].items()) add(fmt::format("{}: {:.6g}", key, value.get<double>()));
  }
  add("\nsensor           mount x, y, yaw    geometry                    ranges  in range  no return   near    far    "
      "nan   min / 25 % / median / 75 % / max, m");
  for (const Json& i : s["sensors"]) {
    const Json& m = i["mount_m_deg"];
    const std::string geometry = i.contains("beams")
                                     ? fmt::format("{} beams {:g} + {:g} deg", i["beams"].get<int>(),
                                                   i["first_beam_deg"].get<double>(), i["beam_step_deg"].get<double>())
                                     : fmt::format("cone {:g} deg", i["aperture_deg"].get<double>());
    const auto n = i["ranges"].get<std::uint64_t>();
    const double none = n == 0 ? 0 : 100 * i["no_return"].get<double>() / static_cast<double>(n);
    std::string five;
    if (const Json& q = i["range_quantiles_m"]; !q.empty()) {
      five = fmt::format("{:.2f} / {:.2f} / {:.2f} / {:.2f} / {:.2f}", q[0].get<double>(), q[2].get<double>(),
                         q[3].get<double>(), q[4].get<double>(), q[6].get<double>());
    }
    add(fmt::format("{:<16} {:>5g} {:>5g} {:>5g}  {:<26} {:>8} {:>9} {:>8.1f} % {:>6} {:>6} {:>6}   {}",
                    i["kind"].get<std::string>() + " " + i["name"].get<std::string>(), m[0].get<double>(),
                    m[1].get<double>(), m[2].get<double>(), geometry, n, i["in_range"].get<std::uint64_t>(), none,
                    i["too_near"].get<std::uint64_t>(), i["too_far"].get<std::uint64_t>(),
                    i["not_a_number"].get<std::uint64_t>(), five));
  }
  out += "\n";
  for (const char* table : {"records_skipped", "records_malformed"}) {
    std::string line;
    for (const auto& [key, n] : s[table].items()) line += fmt::format(" {} {},", key, n.get<std::uint64_t>());
    if (!line.empty()) line.pop_back();
    add(fmt::format("{}:{}", table, line.empty() ? " none" : line));
  }
  for (const Json& warning : s["warnings"]) add("  " + warning.get<std::string>());
  return out;
}

}  // namespace evigrid::driver
