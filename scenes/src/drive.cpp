// SPDX-License-Identifier: Apache-2.0
// The waypoint driver: turn on the spot at the turn rate, the shorter way round, then straight ahead at the speed. The
// pose is a function of time, so that step i does not carry the rounding of the steps before it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "evigrid/scenes/simulate.hpp"

namespace evigrid::scenes {
namespace {

/// A stretch of the run with constant speed and turn rate.
struct Leg {
  double begin_s, duration_s;
  Pose start;
  double speed_m_s, turn_rate_rad_s;

  [[nodiscard]] Pose at(double time_s) const {
    const double t = std::min(std::max(time_s - begin_s, 0.0), duration_s), run_m = speed_m_s * t;
    return {start.x_m + run_m * std::cos(start.yaw_rad), start.y_m + run_m * std::sin(start.yaw_rad),
            start.yaw_rad + turn_rate_rad_s * t};
  }
};

std::vector<Leg> plan(const TrajectorySpec& run) {
  std::vector<Leg> legs;
  double time_s = 0;
  Pose pose{run.waypoints[0].x_m, run.waypoints[0].y_m, 0};
  bool placed = false;  // the robot starts out facing its first goal
  for (std::size_t i = 1; i < run.waypoints.size(); ++i) {
    const raycast::Point goal = run.waypoints[i];
    const double dx = goal.x_m - pose.x_m, dy = goal.y_m - pose.y_m, distance_m = std::hypot(dx, dy);
    if (distance_m == 0) continue;
    const double heading = std::atan2(dy, dx), turn = std::remainder(heading - pose.yaw_rad, 2 * std::numbers::pi);
    if (placed && turn != 0) {
      const double rate = turn < 0 ? -run.turn_rate_rad_s : run.turn_rate_rad_s;
      legs.push_back({time_s, turn / rate, pose, 0, rate});
      time_s += turn / rate;
    }
    placed = true;
    pose.yaw_rad = heading;
    legs.push_back({time_s, distance_m / run.speed_m_s, pose, run.speed_m_s, 0});
    time_s += distance_m / run.speed_m_s;
    pose.x_m = goal.x_m;
    pose.y_m = goal.y_m;
  }
  legs.push_back({time_s, 0, pose, 0, 0});
  return legs;
}

}  // namespace

std::vector<Pose> drive(const TrajectorySpec& trajectory) {
  std::vector<Pose> poses;
  if (trajectory.waypoints.empty()) return poses;
  const std::vector<Leg> legs = plan(trajectory);
  const double end_s = legs.back().begin_s;
  const auto steps = static_cast<std::size_t>(std::ceil(end_s / trajectory.period_s - 1e-9)) + 1;
  std::size_t leg = 0;
  for (std::size_t i = 0; i < steps; ++i) {
    const double time_s = static_cast<double>(i) * trajectory.period_s;
    while (leg + 1 < legs.size() && time_s >= legs[leg + 1].begin_s) ++leg;
    poses.push_back(legs[leg].at(time_s));
  }
  // The last period may be cut short: the run ends where it should.
  poses.back() = legs.back().start;
  return poses;
}

}  // namespace evigrid::scenes
