// SPDX-License-Identifier: Apache-2.0
// A map and the sensors of one robot in it: what a behaviour fuses into.
#pragma once
#include <cstdint>
#include <vector>

#include "evigrid/evigrid.hpp"
#include "evigrid/scenes/live.hpp"
#include "evigrid/scenes/scene.hpp"

namespace evigrid::driver {

[[nodiscard]] inline Pose2 to_engine(const scenes::Pose& p) { return {p.x_m, p.y_m, p.yaw_rad}; }

/// What a sonar that hears nothing says: nothing (the engine's view), or that its cone is empty up to the full range,
/// as a transducer does that then returns its largest range.
enum class NoEcho { nothing, empty_cone };

class RobotMap {
 public:
  /// empty_cone: for sonars of the model hughes1992. Throws InputError when the scene's sensors cannot be used.
  RobotMap(const scenes::Scene& robot, const MapParams& params, std::shared_ptr<Executor> executor,
           NoEcho no_echo = NoEcho::nothing);
  /// Fuses one scan from where the robot believes to be.
  Report fuse(const scenes::Sensed& sensed, const scenes::Pose& T_map_robot, double time_s);
  Map map;

 private:
  std::vector<SensorId> ids_;
  std::vector<SensorId> silent_;    // the same sonars without an occupied arc, for no echo; empty: it says nothing
  std::vector<float> full_m_;       // what those read
  std::vector<std::size_t> beams_;  // of each sensor; 1 for a sonar
  std::size_t sonars_ = 0;
};

}  // namespace evigrid::driver
