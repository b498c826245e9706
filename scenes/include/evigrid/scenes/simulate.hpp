// SPDX-License-Identifier: Apache-2.0
// Drives the robot of a scene and lets its sensors measure: step i gives the time, the true pose, the pose that the
// robot believes in and one range per sonar and laser beam. Steps are independent of one another: any order and any
// number of threads give the same numbers.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "evigrid/raycast/scene.hpp"
#include "evigrid/scenes/scene.hpp"

namespace evigrid::scenes {

/// Where a motion of `way_m` along the heading that changes by `turn_rad` on the way leads to: the chord of the arc.
[[nodiscard]] Pose advance(const Pose& from, double way_m, double turn_rad) noexcept;

/// A trajectory as a function of time, so that step i does not carry the rounding of the steps before it.
class Route {
 public:
  explicit Route(const TrajectorySpec& trajectory);

  [[nodiscard]] double duration_s() const noexcept { return legs_.back().begin_s; }
  /// Before the start: the start; after the end: the end.
  [[nodiscard]] Pose at(double time_s) const;
  /// The motions between two times, in order.
  [[nodiscard]] std::vector<Motion> between(double from_s, double to_s) const;

 private:
  struct Leg {
    double begin_s;
    Pose start;
    Motion motion;
  };
  [[nodiscard]] std::size_t leg_at(double time_s) const;
  std::vector<Leg> legs_;  // the last one stands still at the end, for no time
};

/// True poses of the robot at 0, period, 2·period, …, the last one at the end of the route. Deterministic.
[[nodiscard]] std::vector<Pose> drive(const TrajectorySpec& trajectory);

/// T_odom_robot at the same times: the motions that the wheels report, summed up. It starts at the true pose.
[[nodiscard]] std::vector<Pose> dead_reckoning(const TrajectorySpec& trajectory, const OdometrySpec& odometry);

struct Step {
  std::int64_t stamp_ns = 0;    ///< step · period
  Pose T_map_robot;             ///< true pose
  Pose T_odom_robot;            ///< believed pose; the true one when the scene has no odometry
  std::vector<float> ranges_m;  ///< per sonar: with noise; +∞ for no echo, −∞ for an echo nearer than min_range_m
  std::vector<float> beams_m;   ///< the same for the beams of all lasers, one laser after the other
};

class Simulation {
 public:
  /// Keeps a copy of the scene and a reference to the caster, which must live longer and know the scene's movers.
  Simulation(Scene scene, const raycast::Scene& caster);

  [[nodiscard]] std::size_t steps() const noexcept { return poses_.size(); }
  [[nodiscard]] const std::vector<Pose>& poses() const noexcept { return poses_; }

  /// i < steps(). Noise is keyed by (seed, robot 0, sensor, i) and the beam, lasers being numbered after the sonars; a
  /// noisy range beyond the sensor's limits becomes ±∞.
  [[nodiscard]] Step step(std::size_t i) const;

  /// Steps first, first + 1, … as step() gives them. `threads`: 0 for as many as the machine has.
  [[nodiscard]] std::vector<Step> run(std::size_t first, std::size_t count, int threads = 1) const;

  /// Where the movers stand at step i.
  [[nodiscard]] std::vector<raycast::Placement> movers_at(std::size_t i) const;

 private:
  void measure(std::size_t first, std::size_t count, Step* steps) const;
  Scene scene_;
  std::vector<Pose> poses_, believed_;
  std::vector<Route> movers_;
  const raycast::Scene* caster_;
};

/// The caster of a scene: its world and the shapes of its movers.
[[nodiscard]] raycast::Scene make_caster(const Scene& scene);

/// All steps at once.
[[nodiscard]] std::vector<Step> simulate(const Scene& scene, const raycast::Scene& caster, int threads = 1);

}  // namespace evigrid::scenes
