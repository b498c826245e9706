// SPDX-License-Identifier: Apache-2.0
// The avoid agent's artificial potential field (Khatib 1986), which is also the planner that the paper sets against its
// own: the goal draws, every echo pushes.
#pragma once
#include <vector>

#include "evigrid/scenes/scene.hpp"

namespace evigrid::driver {

struct Drive {
  double speed_m_s = 0, turn_rate_rad_s = 0;
};

struct DriveLimits {
  double speed_m_s = 0.2, turn_rate_rad_s = 50 * 3.14159265358979 / 180;  ///< as the scene's robot
};

/// Where the echoes of a scan came from if each lies on its beam's axis.
[[nodiscard]] std::vector<raycast::Point> echoes(const scenes::Scene& robot, const std::vector<float>& ranges_m,
                                                 const scenes::Pose& T_map_robot);

/// The force of the field at the robot: 1 towards the goal, and from every echo nearer than `reach_m` to the body
/// k (1/d − 1/reach)/d² away from it, d from the body's rim.
[[nodiscard]] raycast::Point force(const std::vector<raycast::Point>& echoes, raycast::Point at, raycast::Point goal,
                                   double radius_m);

/// Towards a direction of the map: turns with the error, and drives the slower the larger it is.
[[nodiscard]] Drive towards(double direction_rad, double yaw_rad, const DriveLimits& limits);

}  // namespace evigrid::driver
