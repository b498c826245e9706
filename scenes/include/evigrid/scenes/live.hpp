// SPDX-License-Identifier: Apache-2.0
// A robot that decides as it goes: it senses, moves a stretch, and senses again. For behaviours, which a route made
// beforehand (simulate.hpp) cannot drive. What it measures at a pose is what a simulated run measures there.
#pragma once
#include <cstdint>
#include <vector>

#include "evigrid/raycast/scene.hpp"
#include "evigrid/scenes/fleet.hpp"
#include "evigrid/scenes/scene.hpp"

namespace evigrid::scenes {

struct Sensed {
  std::vector<float> ranges_m;  ///< per sonar, as Step::ranges_m
  std::vector<float> beams_m;   ///< of all lasers, one after the other
};

struct Moved {
  double way_m = 0, turn_rad = 0;  ///< what was really driven
  bool stopped = false;            ///< before the end, because the body would have touched a surface
};

class LiveRobot {
 public:
  /// Keeps references to caster and floor, which must live longer. Of `robot` the radius, the sensors, echoes, odometry
  /// and the trajectory's seed are used.
  LiveRobot(const Floor& floor, const raycast::Scene& caster, Scene robot, const Pose& start);

  [[nodiscard]] const Pose& pose() const noexcept { return pose_; }          ///< true
  [[nodiscard]] const Pose& believed() const noexcept { return believed_; }  ///< by its wheels, and by correct()
  void correct(const Pose& believed) noexcept { believed_ = believed; }
  [[nodiscard]] double way_m() const noexcept { return way_m_; }  ///< driven so far

  /// One scan of all sensors. Every call is a step of its own: noise is keyed by the number of calls before it.
  [[nodiscard]] Sensed sense(raycast::Scene::Placements movers = {});

  /// Turns on the spot, then drives straight, forwards or back; stops within 1 cm of the place where the body would
  /// touch a surface that does not move. Wheel noise as in dead_reckoning.
  Moved move(double turn_rad, double way_m);
  /// Speed and turn rate together for a while: an arc.
  Moved move(const Motion& motion);

 private:
  Scene robot_;
  const Floor* floor_;
  const raycast::Scene* caster_;
  Pose pose_, believed_;
  double way_m_ = 0;
  std::uint64_t sensed_ = 0, moved_ = 0;
};

}  // namespace evigrid::scenes
