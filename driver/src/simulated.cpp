// SPDX-License-Identifier: Apache-2.0
// Where words of the scene (names as text) become words of the engine.
#include "simulated.hpp"

#include <fmt/format.h>

#include "error.hpp"
#include "evigrid/raycast/scene.hpp"
#include "evigrid/scenes/simulate.hpp"
#include "mapping.hpp"
#include "options.hpp"
#include "progress.hpp"

namespace evigrid::driver {
namespace {

Pose2 to_engine(const scenes::Pose& p) { return {p.x_m, p.y_m, p.yaw_rad}; }

}  // namespace

SceneInput open_scene(const std::string& path) {
  try {
    if (path.empty())
      return {"(embedded scene)", scenes::parse_scene(scenes::default_scene_text(), "(embedded scene)")};
    return {path, scenes::load_scene(path)};
  } catch (const scenes::SceneError& error) {
    throw InputError(error.what());
  }
}

Simulated simulate(const scenes::Scene& scene, bool no_noise) {
  const auto start = Clock::now();
  Simulated out;
  out.log.format = "scene";
  scenes::Scene copy = scene;
  for (scenes::SonarSpec& sonar : copy.sonars) {
    if (no_noise) sonar.noise = {};
    Sensor s;
    s.model = parse_model(sonar.model);
    s.T_robot_sensor = to_engine(sonar.T_robot_sensor);
    s.aperture_rad = sonar.aperture_rad;
    s.min_range_m = sonar.min_range_m;
    s.max_range_m = sonar.max_range_m;
    s.reliability = sonar.reliability;
    out.log.sensors.push_back({"sonar", s});
  }
  const raycast::Scene caster(copy.world);
  const scenes::Simulation simulation(copy, caster);
  Progress progress("casting");
  for (std::size_t i = 0; i < simulation.steps(); ++i) {
    const scenes::Step step = simulation.step(i);
    out.log.scans.push_back(
        {step.stamp_ns, to_engine(step.T_map_robot), out.log.readings.size(), step.ranges_m.size()});
    for (std::size_t k = 0; k < step.ranges_m.size(); ++k) {
      out.log.readings.push_back({k, out.log.ranges_m.size(), 1});
      out.log.ranges_m.push_back(step.ranges_m[k]);
    }
    progress.show(i + 1, simulation.steps());
  }
  out.cast_s = seconds_since(start);
  return out;
}

}  // namespace evigrid::driver
