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

class RobotMap {
 public:
  /// Throws InputError when the scene's sensors cannot be used.
  RobotMap(const scenes::Scene& robot, const MapParams& params, std::shared_ptr<Executor> executor);
  /// Fuses one scan from where the robot believes to be.
  Report fuse(const scenes::Sensed& sensed, const scenes::Pose& T_map_robot, double time_s);
  Map map;

 private:
  std::vector<SensorId> ids_;
  std::vector<std::size_t> beams_;  // of each sensor; 1 for a sonar
  std::size_t sonars_ = 0;
};

}  // namespace evigrid::driver
