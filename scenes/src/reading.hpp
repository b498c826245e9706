// SPDX-License-Identifier: Apache-2.0
// From a sensor's description to the question for the caster, and from its answer to the number that the sensor gives.
#pragma once
#include <cstdint>
#include <limits>

#include "evigrid/raycast/cone.hpp"
#include "evigrid/scenes/scene.hpp"

namespace evigrid::scenes {

inline raycast::ConeQuery query(const SonarSpec& sonar, const Pose& T_map_sensor) {
  return {T_map_sensor.x_m,   T_map_sensor.y_m,  T_map_sensor.yaw_rad,
          sonar.aperture_rad, sonar.min_range_m, sonar.max_range_m};
}

inline raycast::FanQuery query(const LaserSpec& laser, const Pose& T_map_sensor) {
  return {T_map_sensor.x_m, T_map_sensor.y_m, T_map_sensor.yaw_rad, laser.first_rad,
          laser.step_rad,   laser.beams,      laser.max_range_m};
}

inline raycast::Echo echo_of(double range_m, const LaserSpec& laser) {
  if (!(range_m <= laser.max_range_m)) return {};
  return {range_m < laser.min_range_m ? raycast::EchoStatus::too_close : raycast::EchoStatus::ok, range_m};
}

/// What the sensor says: its echo with noise, or that there was none, or that it was too near to be timed.
template <class Sensor>
float reading(const raycast::Echo& echo, const Sensor& sensor, const raycast::NoiseKey& key, std::uint32_t beam = 0) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  if (echo.status == raycast::EchoStatus::none) return kInfinity;
  if (echo.status == raycast::EchoStatus::too_close) return -kInfinity;
  const bool exact = sensor.noise.sigma_m == 0 && sensor.noise.ratio == 0;
  const double range_m = exact ? echo.range_m : raycast::noisy(echo.range_m, sensor.noise, key, beam);
  if (range_m > sensor.max_range_m) return kInfinity;
  if (range_m < sensor.min_range_m) return -kInfinity;
  return static_cast<float>(range_m);
}

}  // namespace evigrid::scenes
