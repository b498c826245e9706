// SPDX-License-Identifier: Apache-2.0
// Drives the robot of a scene and pings: step i gives the time, the true pose and one range per sonar. Steps are
// independent of one another: any order and any number of threads give the same numbers.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "evigrid/raycast/scene.hpp"
#include "evigrid/scenes/scene.hpp"

namespace evigrid::scenes {

/// True poses of the robot at 0, period, 2·period, …, the last one at the last waypoint. Deterministic.
[[nodiscard]] std::vector<Pose> drive(const TrajectorySpec& trajectory);

struct Step {
  std::int64_t stamp_ns = 0;    ///< step · period
  Pose T_map_robot;             ///< true pose
  std::vector<float> ranges_m;  ///< per sonar: with noise; +∞ for no echo, −∞ for an echo nearer than min_range_m
};

class Simulation {
 public:
  /// Keeps a copy of the scene and a reference to the caster, which must live longer.
  Simulation(Scene scene, const raycast::Scene& caster);

  [[nodiscard]] std::size_t steps() const noexcept { return poses_.size(); }
  [[nodiscard]] const std::vector<Pose>& poses() const noexcept { return poses_; }

  /// i < steps(). Noise is keyed by (seed, robot 0, sensor, i); a noisy range beyond the sensor's limits becomes ±∞.
  [[nodiscard]] Step step(std::size_t i) const;

 private:
  Scene scene_;
  std::vector<Pose> poses_;
  const raycast::Scene* caster_;
};

/// All steps at once.
[[nodiscard]] std::vector<Step> simulate(const Scene& scene, const raycast::Scene& caster);

}  // namespace evigrid::scenes
