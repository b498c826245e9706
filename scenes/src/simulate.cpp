// SPDX-License-Identifier: Apache-2.0
#include "evigrid/scenes/simulate.hpp"

#include <cmath>
#include <limits>

namespace evigrid::scenes {
namespace {

/// What the sonar says: its echo with noise, or that there was none, or that it was too near to be timed.
float reading(const raycast::Echo& echo, const SonarSpec& sonar, const raycast::NoiseKey& key) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  if (echo.status == raycast::EchoStatus::none) return kInfinity;
  if (echo.status == raycast::EchoStatus::too_close) return -kInfinity;
  const double range_m = raycast::noisy(echo.range_m, sonar.noise, key);
  if (range_m > sonar.max_range_m) return kInfinity;
  if (range_m < sonar.min_range_m) return -kInfinity;
  return static_cast<float>(range_m);
}

}  // namespace

Pose compose(const Pose& a, const Pose& b) noexcept {
  const double c = std::cos(a.yaw_rad), s = std::sin(a.yaw_rad);
  return {a.x_m + c * b.x_m - s * b.y_m, a.y_m + s * b.x_m + c * b.y_m, a.yaw_rad + b.yaw_rad};
}

Simulation::Simulation(Scene scene, const raycast::Scene& caster)
    : scene_(std::move(scene)), poses_(drive(scene_.trajectory)), caster_(&caster) {}

Step Simulation::step(std::size_t i) const {
  Step step;
  step.stamp_ns = std::llround(static_cast<double>(i) * scene_.trajectory.period_s * 1e9);
  step.T_map_robot = poses_.at(i);
  step.ranges_m.reserve(scene_.sonars.size());
  for (std::uint32_t sensor = 0; sensor < scene_.sonars.size(); ++sensor) {
    const SonarSpec& sonar = scene_.sonars[sensor];
    const Pose T_map_sensor = compose(step.T_map_robot, sonar.T_robot_sensor);
    const raycast::Echo echo = caster_->cast_cone({T_map_sensor.x_m, T_map_sensor.y_m, T_map_sensor.yaw_rad,
                                                   sonar.aperture_rad, sonar.min_range_m, sonar.max_range_m});
    step.ranges_m.push_back(reading(echo, sonar, {scene_.trajectory.seed, 0, sensor, i}));
  }
  return step;
}

std::vector<Step> simulate(const Scene& scene, const raycast::Scene& caster) {
  const Simulation simulation(scene, caster);
  std::vector<Step> steps;
  for (std::size_t i = 0; i < simulation.steps(); ++i) steps.push_back(simulation.step(i));
  return steps;
}

}  // namespace evigrid::scenes
