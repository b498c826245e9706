// SPDX-License-Identifier: Apache-2.0
// Either a ring of equal sonars that look outwards, or a list of single ones; what a single one does not say is taken
// from [robot.sensor].
#include <cmath>
#include <numbers>

#include "read.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::int64_t kMostSonars = 1024;
constexpr Limits kRange_m{0, 1000}, kMount_m{-100, 100}, kTurn_deg{-360, 360};

/// Fields of a sensor, over those of `base`; without a base all that have no natural value are required.
SonarSpec read_sensor(Table& t, const SonarSpec* base) {
  SonarSpec s = base ? *base : SonarSpec{};
  const auto required = [&](const char* key) { return !base || t.has(key); };
  s.model = required("model") ? t.text("model") : t.text_or("model", s.model);
  const Limits aperture_deg{0, 60, true};
  s.aperture_rad = required("aperture_deg") ? t.angle("aperture_deg", aperture_deg)
                                            : t.angle_or("aperture_deg", aperture_deg, s.aperture_rad);
  s.min_range_m = t.number_or("min_range_m", kRange_m, s.min_range_m);
  s.max_range_m =
      required("max_range_m") ? t.number("max_range_m", kRange_m) : t.number_or("max_range_m", kRange_m, s.max_range_m);
  if (s.max_range_m <= s.min_range_m) t.fail("max_range_m", "must be greater than min_range_m");
  s.reliability = t.number_or("reliability", {0, 1, true}, s.reliability);
  s.noise.sigma_m = t.number_or("noise_sigma_m", {0, 10}, s.noise.sigma_m);
  s.noise.ratio = t.number_or("noise_ratio", {0, 1}, s.noise.ratio);
  return s;
}

void add_ring(Table ring, const SonarSpec& base, std::vector<SonarSpec>& sonars) {
  const std::int64_t count = ring.integer("count", 1, kMostSonars);
  const double radius_m = ring.number("radius_m", {0, 100});
  const double first_rad = ring.angle_or("first_bearing_deg", kTurn_deg, 0);
  ring.refuse_unknown_keys();
  for (std::int64_t i = 0; i < count; ++i) {
    const double bearing = first_rad + 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    sonars.push_back(base);
    sonars.back().T_robot_sensor = {radius_m * std::cos(bearing), radius_m * std::sin(bearing), bearing};
  }
}

}  // namespace

std::vector<SonarSpec> read_robot(Table robot) {
  Table sensor = robot.table("sensor");
  const SonarSpec base = read_sensor(sensor, nullptr);
  sensor.refuse_unknown_keys();
  std::vector<SonarSpec> sonars;
  if (Table ring = robot.table_or_empty("ring"); robot.has("ring")) add_ring(ring, base, sonars);
  for (Table& t : robot.tables("sonar", kMostSonars)) {
    sonars.push_back(read_sensor(t, &base));
    sonars.back().T_robot_sensor = {t.number("x_m", kMount_m), t.number("y_m", kMount_m),
                                    t.angle("yaw_deg", kTurn_deg)};
    t.refuse_unknown_keys();
  }
  robot.refuse_unknown_keys();
  if (sonars.empty()) robot.fail("", "has no sonar: neither [robot.ring] nor [[robot.sonar]]");
  return sonars;
}

}  // namespace evigrid::scenes
