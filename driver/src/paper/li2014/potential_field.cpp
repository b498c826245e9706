// SPDX-License-Identifier: Apache-2.0
#include "paper/li2014/potential_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace evigrid::driver {
namespace {

constexpr double kReach_m = 0.35;    // beyond it an echo does not push
constexpr double kPush = 2e-3;       // m²: an echo 0.11 m from the rim balances the goal
constexpr double kNearest_m = 0.02;  // no force grows beyond what it has here
constexpr double kGain = 2;          // rad/s a radian

}  // namespace

std::vector<raycast::Point> echoes(const scenes::Scene& robot, const std::vector<float>& ranges_m,
                                   const scenes::Pose& at) {
  std::vector<raycast::Point> out;
  for (std::size_t i = 0; i < robot.sonars.size(); ++i) {
    const double r = ranges_m[i];
    if (!std::isfinite(r)) continue;
    const scenes::Pose p = compose(compose(at, robot.sonars[i].T_robot_sensor), scenes::Pose{r, 0, 0});
    out.push_back({p.x_m, p.y_m});
  }
  return out;
}

raycast::Point force(const std::vector<raycast::Point>& echoes, raycast::Point at, raycast::Point goal,
                     double radius_m) {
  const double to_goal = std::max(std::hypot(goal.x_m - at.x_m, goal.y_m - at.y_m), 1e-9);
  raycast::Point f{(goal.x_m - at.x_m) / to_goal, (goal.y_m - at.y_m) / to_goal};
  for (const raycast::Point& e : echoes) {
    const double away = std::max(std::hypot(at.x_m - e.x_m, at.y_m - e.y_m), 1e-9);
    const double d = std::max(away - radius_m, kNearest_m);
    if (d >= kReach_m) continue;
    const double push = kPush * (1 / d - 1 / kReach_m) / (d * d);
    f.x_m += push * (at.x_m - e.x_m) / away;
    f.y_m += push * (at.y_m - e.y_m) / away;
  }
  return f;
}

Drive towards(double direction_rad, double yaw_rad, const DriveLimits& limits) {
  const double error = std::remainder(direction_rad - yaw_rad, 2 * std::numbers::pi);
  return {limits.speed_m_s * std::max(0.0, std::cos(error)) * std::max(0.0, 1 - std::abs(error)),
          std::clamp(kGain * error, -limits.turn_rate_rad_s, limits.turn_rate_rad_s)};
}

}  // namespace evigrid::driver
