// SPDX-License-Identifier: Apache-2.0
// A robot: a ring of equal sonars that look outwards, single sonars, lasers, and how well it knows its way. What a
// sonar does not say is taken from [robot.sensor].
#include <cmath>
#include <numbers>

#include "read.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::int64_t kMostSonars = 1024, kMostLasers = 64, kMostBeams = 100'000, kMostGroups = 1024;
constexpr Limits kRange_m{0, 1000}, kMount_m{-100, 100}, kTurn_deg{-360, 360};

/// Limits, noise and reliability: what sonars and lasers share. `base` has the values of what is not said.
template <class Sensor>
void read_common(Table& t, Sensor& s, bool range_required, const Vocabulary& words) {
  s.min_range_m = t.number_or("min_range_m", kRange_m, s.min_range_m);
  s.max_range_m =
      range_required ? t.number("max_range_m", kRange_m) : t.number_or("max_range_m", kRange_m, s.max_range_m);
  if (s.max_range_m <= s.min_range_m) t.fail("max_range_m", "must be greater than min_range_m");
  s.reliability = t.number_or("reliability", {0, 1, true}, s.reliability);
  s.decay_s = t.number_or("decay_s", {0, 1e9}, s.decay_s);
  s.dependence = t.text_or("dependence", s.dependence);
  if (t.has("dependence")) require_known(t, "dependence", s.dependence, words.dependences);
  s.weight_exponent = t.number_or("weight_exponent", {1e-3, 1}, s.weight_exponent);
  s.noise.sigma_m = t.number_or("noise_sigma_m", {0, 10}, s.noise.sigma_m);
  s.noise.ratio = t.number_or("noise_ratio", {0, 1}, s.noise.ratio);
}

Pose read_mount(Table& t) {
  return {t.number("x_m", kMount_m), t.number("y_m", kMount_m), t.angle("yaw_deg", kTurn_deg)};
}

/// [….MODEL] tables: parameters of sensor models, over those of `all`.
void read_parameters(Table& t, const std::vector<std::string>& models, const Vocabulary& words, ModelParameters& all) {
  for (const std::string& model : models) {
    if (!t.has(model)) continue;
    Table own = t.table(model);
    for (const Vocabulary::Parameter& p : words.parameters) {
      if (p.model != model || !own.has(p.name)) continue;
      all[model][p.name] =
          p.is_switch ? static_cast<double>(own.boolean_or(p.name, false)) : own.number(p.name, {p.least, p.most});
    }
    own.refuse_unknown_keys();
  }
}

/// Fields of a sonar, over those of `base`; without a base all that have no natural value are required.
SonarSpec read_sonar(Table& t, const SonarSpec* base, const Vocabulary& words) {
  SonarSpec s = base ? *base : SonarSpec{};
  const auto required = [&](const char* key) { return !base || t.has(key); };
  s.model = required("model") ? t.text("model") : t.text_or("model", s.model);
  if (required("model")) require_known(t, "model", s.model, words.sonar_models);
  const Limits aperture_deg{0, 60, true};
  s.aperture_rad = required("aperture_deg") ? t.angle("aperture_deg", aperture_deg)
                                            : t.angle_or("aperture_deg", aperture_deg, s.aperture_rad);
  read_common(t, s, required("max_range_m"), words);
  read_parameters(t, words.sonar_models, words, s.parameters);
  if (t.has("group")) s.group = static_cast<int>(t.integer("group", 0, kMostGroups - 1));
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

std::vector<SonarSpec> read_sonars(Table& robot, const Vocabulary& words) {
  std::vector<SonarSpec> sonars;
  std::vector<Table> singles = robot.tables("sonar", kMostSonars);
  const bool any = robot.has("ring") || !singles.empty();
  Table sensor = any ? robot.table("sensor") : robot.table_or_empty("sensor");
  Table ring = robot.table_or_empty("ring");
  if (!any && !robot.has("sensor")) return sonars;
  const SonarSpec base = read_sonar(sensor, nullptr, words);
  sensor.refuse_unknown_keys();
  if (robot.has("ring")) add_ring(ring, base, sonars);
  for (Table& t : singles) {
    sonars.push_back(read_sonar(t, &base, words));
    sonars.back().T_robot_sensor = read_mount(t);
    t.refuse_unknown_keys();
  }
  return sonars;
}

LaserSpec read_laser(Table& t, const Vocabulary& words) {
  LaserSpec s;
  s.model = t.text_or("model", s.model);
  if (t.has("model")) require_known(t, "model", s.model, words.laser_models);
  s.T_robot_sensor = read_mount(t);
  s.first_rad = t.angle("first_deg", kTurn_deg);
  s.step_rad = t.angle("step_deg", {0, 360, true});
  s.beams = static_cast<int>(t.integer("beams", 1, kMostBeams));
  constexpr double kRound = 1e-9;  // 360 steps of one degree are a circle, whatever their sum rounds to
  if (s.step_rad * s.beams > 2 * std::numbers::pi + kRound)
    t.fail("step_deg", "times beams is more than a full circle");
  read_common(t, s, true, words);
  read_parameters(t, words.laser_models, words, s.parameters);
  t.refuse_unknown_keys();
  return s;
}

OdometrySpec read_odometry(Table t) {
  OdometrySpec o;
  o.used = t.has("drift_left") || t.has("drift_right") || t.has("noise_m_per_sqrt_m");
  o.track_m = t.number_or("track_m", {1e-3, 100}, o.track_m);
  o.drift_left = t.number_or("drift_left", {-1, 1}, o.drift_left);
  o.drift_right = t.number_or("drift_right", {-1, 1}, o.drift_right);
  o.noise_m_per_sqrt_m = t.number_or("noise_m_per_sqrt_m", {0, 10}, o.noise_m_per_sqrt_m);
  t.refuse_unknown_keys();
  return o;
}

EchoSpec read_echo(Table t) {
  EchoSpec echo;
  echo.second_bounce = t.boolean_or("second_bounce", echo.second_bounce);
  echo.cross_talk = t.boolean_or("cross_talk", echo.cross_talk);
  t.refuse_unknown_keys();
  return echo;
}

}  // namespace

void read_robot(Table robot, Scene& scene, const Vocabulary& words) {
  (void)robot.text_or("use", "");  // merged already; named here as a known key
  scene.radius_m = robot.number_or("radius_m", {0, 100}, 0.2);
  scene.sonars = read_sonars(robot, words);
  scene.lasers.clear();
  for (Table& t : robot.tables("laser", kMostLasers)) scene.lasers.push_back(read_laser(t, words));
  scene.echo = read_echo(robot.table_or_empty("echo"));
  scene.odometry = read_odometry(robot.table_or_empty("odometry"));
  robot.refuse_unknown_keys();
  if (scene.sonars.empty() && scene.lasers.empty())
    robot.fail("", "has no sensor: neither [robot.ring] nor [[robot.sonar]] nor [[robot.laser]]");
}

}  // namespace evigrid::scenes
