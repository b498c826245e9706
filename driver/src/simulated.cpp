// SPDX-License-Identifier: Apache-2.0
// Where words of the scene (names as text) become words of the engine.
#include "simulated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "error.hpp"
#include "evigrid/raycast/scene.hpp"
#include "mapping.hpp"
#include "options.hpp"
#include "progress.hpp"

namespace evigrid::driver {
namespace {

constexpr std::size_t kBatch = 512;                         // steps a call: threads stay busy, progress stays smooth
constexpr std::size_t kBatchBytes = std::size_t{64} << 20;  // of its ranges
constexpr std::size_t kMostBytes = std::size_t{4} << 30;    // of one run's readings

Pose2 to_engine(const scenes::Pose& p) { return {p.x_m, p.y_m, p.yaw_rad}; }

template <class Spec>
Sensor common(const Spec& spec) {
  Sensor s;
  s.model = parse_model(spec.model);
  s.T_robot_sensor = to_engine(spec.T_robot_sensor);
  s.min_range_m = spec.min_range_m;
  s.max_range_m = spec.max_range_m;
  s.reliability = spec.reliability;
  s.decay_s = spec.decay_s;
  if (const auto policy = dependence_from_name(spec.dependence)) s.dependence = *policy;
  s.weight_exponent = spec.weight_exponent;
  for (const auto& [model, values] : spec.parameters) {
    for (const auto& [field, value] : values) set_model_param(s, parse_model(model), field, value);
  }
  return s;
}

}  // namespace

std::vector<LogSensor> declared_sensors(const scenes::Scene& scene) {
  std::vector<LogSensor> out;
  for (const scenes::SonarSpec& sonar : scene.sonars) {
    Sensor s = common(sonar);
    if (s.model == Model::beam) throw InputError("robot.sonar.model: beam is for lasers");
    s.aperture_rad = sonar.aperture_rad;
    out.push_back({"sonar", s, {}, true});
  }
  for (const scenes::LaserSpec& laser : scene.lasers) {
    Sensor s = common(laser);
    if (s.model != Model::beam) throw InputError(fmt::format("robot.laser.model: {} is for sonars", laser.model));
    s.beams = laser.beams;
    s.first_beam_rad = laser.first_rad;
    s.beam_step_rad = laser.step_rad;
    out.push_back({"laser", s, {}, true});
  }
  return out;
}

namespace {

std::size_t ranges_a_step(const scenes::Scene& scene) {
  std::size_t ranges = scene.sonars.size();
  for (const scenes::LaserSpec& laser : scene.lasers) ranges += static_cast<std::size_t>(laser.beams);
  return ranges;
}

void require_memory(const scenes::Scene& scene, std::size_t steps) {
  const std::size_t beams = ranges_a_step(scene);
  const std::size_t bytes_a_step = beams * sizeof(float) + scene.sonars.size() * sizeof(LogReading) + sizeof(LogScan);
  if (steps > kMostBytes / bytes_a_step) {
    throw InputError(
        fmt::format("the run has {} steps of {} ranges each: more than {} GiB; a longer period_s, or fewer "
                    "beams, help",
                    steps, beams, kMostBytes >> 30));
  }
}

/// A way through a wall is most likely a slip in the scene's numbers; a map of it would look like a broken mapper.
void warn_of_walls(const raycast::Scene& caster, const std::vector<scenes::Pose>& poses,
                   std::vector<std::string>& warnings) {
  std::size_t crossings = 0;
  std::string first;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const scenes::Pose &a = poses[i - 1], &b = poses[i];
    const double way_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    if (way_m == 0) continue;
    const double hit_m = caster.ray_range(a.x_m, a.y_m, std::atan2(b.y_m - a.y_m, b.x_m - a.x_m), way_m);
    if (!(hit_m < way_m)) continue;
    if (crossings++ == 0) first = fmt::format("step {} near ({:.2f}, {:.2f})", i, a.x_m, a.y_m);
  }
  if (crossings > 0)
    warnings.push_back(fmt::format("the robot drives through walls in {} of its steps, first in {}", crossings, first));
}

scenes::Scene ideal(scenes::Scene scene) {
  for (scenes::SonarSpec& sonar : scene.sonars) sonar.noise = {};
  for (scenes::LaserSpec& laser : scene.lasers) laser.noise = {};
  scene.echo = {};
  return scene;
}

void append(Log& log, std::size_t sensor, const float* first, std::size_t count) {
  log.readings.push_back({sensor, log.ranges_m.size(), count});
  log.ranges_m.insert(log.ranges_m.end(), first, first + count);
}

}  // namespace

std::string embedded_scene_names() {
  std::string names;
  for (const scenes::Embedded& one : scenes::embedded_scenes())
    names.append(names.empty() ? "" : ", ").append(one.name);
  return names;
}

scenes::Vocabulary vocabulary() {
  scenes::Vocabulary words;
  for (const Rule rule : all_rules()) words.rules.emplace_back(name(rule));
  for (const Dependence d :
       {Dependence::independent, Dependence::cautious, Dependence::once_per_scan, Dependence::weighted})
    words.dependences.emplace_back(name(d));
  for (const Model model : all_models())
    (model == Model::beam ? words.laser_models : words.sonar_models).emplace_back(name(model));
  for (const Model model : all_models()) {
    for (const ModelParam& p : model_params(model))
      words.parameters.push_back({std::string(name(model)), std::string(p.name), p.least, p.most, p.is_switch});
  }
  return words;
}

SceneInput open_scene(const std::string& name_or_path) {
  try {
    if (name_or_path.empty())
      return {"(embedded scene)", scenes::parse_scene(scenes::default_scene_text(), "(embedded scene)", vocabulary())};
    const std::string_view text = scenes::find_embedded(scenes::embedded_scenes(), name_or_path);
    if (!text.empty()) {
      const std::string name = "(embedded scene " + name_or_path + ")";
      return {name, scenes::parse_scene(text, name, vocabulary())};
    }
    return {name_or_path, scenes::load_scene(name_or_path, vocabulary())};
  } catch (const scenes::SceneError& error) {
    // Neither a path nor a file's ending: an embedded scene was meant.
    const bool a_name = name_or_path.find_first_of("./\\") == std::string::npos;
    throw InputError(a_name && !name_or_path.empty() &&
                             scenes::find_embedded(scenes::embedded_scenes(), name_or_path).empty()
                         ? fmt::format("{}; embedded scenes: {}", error.what(), embedded_scene_names())
                         : error.what());
  }
}

void use_map_options(const scenes::Scene& scene, MappingOptions& options) {
  if (options.filter.empty() && scene.map.false_reflection_m >= 0)
    options.filter = fmt::format("false_reflection={}", scene.map.false_reflection_m);
  if (!options.decay_s && scene.map.decay_s > 0) options.decay_s = scene.map.decay_s;
}

Casting::Casting(const scenes::Scene& scene, const CastOptions& options)
    : scene_(options.ideal ? ideal(scene) : scene),
      caster_(scenes::make_caster(scene_)),
      simulation_(scene_, caster_),
      batch_(std::clamp<std::size_t>(kBatchBytes / (sizeof(float) * std::max<std::size_t>(ranges_a_step(scene), 1)), 1,
                                     kBatch)),
      threads_(options.threads) {}

std::vector<scenes::Step> Casting::next() {
  const std::size_t count = std::min(batch_, steps() - done_);
  if (count == 0) return {};
  const std::size_t first = std::exchange(done_, done_ + count);
  return simulation_.run(first, count, threads_);
}

std::vector<std::string> Casting::warnings() const {
  std::vector<std::string> out;
  warn_of_walls(caster_, simulation_.poses(), out);
  if (steps() == 1)
    out.emplace_back(
        "the robot stands still: one scan only; in a tour it has no room to drive, try a smaller robot or another "
        "start");
  return out;
}

Simulated simulate(const scenes::Scene& scene, const CastOptions& options) {
  const auto start = Clock::now();
  Simulated out;
  out.log.format = "scene";
  out.log.sensors = declared_sensors(scene);
  Casting casting(scene, options);
  const std::size_t steps = casting.steps();
  require_memory(scene, steps);
  out.log.warnings = casting.warnings();
  Progress progress("casting");
  for (auto batch = casting.next(); !batch.empty(); batch = casting.next()) {
    for (const scenes::Step& step : batch) {
      out.T_map_robot.push_back(to_engine(step.T_map_robot));
      out.log.scans.push_back({step.stamp_ns, to_engine(step.T_odom_robot), out.log.readings.size(),
                               scene.sonars.size() + scene.lasers.size()});
      std::size_t sensor = 0, beam = 0;
      for (const float& range_m : step.ranges_m) append(out.log, sensor++, &range_m, 1);
      for (const scenes::LaserSpec& laser : scene.lasers) {
        const auto beams = static_cast<std::size_t>(laser.beams);
        append(out.log, sensor++, &step.beams_m[beam], beams);
        beam += beams;
      }
    }
    progress.show(casting.done(), steps);
  }
  out.cast_s = seconds_since(start);
  return out;
}

}  // namespace evigrid::driver
