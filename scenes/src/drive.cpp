// SPDX-License-Identifier: Apache-2.0
// The driver: along waypoints by turning on the spot at the turn rate, the shorter way round, then straight ahead at
// the speed; or legs of constant velocity. The pose is a function of time.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "evigrid/scenes/simulate.hpp"

namespace evigrid::scenes {

Pose advance(const Pose& from, double way_m, double turn_rad) noexcept {
  // The chord of an arc of `turn` has the length way · sin(h)/h, h = turn/2, and looks half the turn ahead. Exact for
  // every turn, and a straight line keeps the bits of a plain product.
  if (turn_rad == 0)
    return {from.x_m + way_m * std::cos(from.yaw_rad), from.y_m + way_m * std::sin(from.yaw_rad), from.yaw_rad};
  const double half = turn_rad / 2, chord_m = way_m * (std::sin(half) / half), towards = from.yaw_rad + half;
  return {from.x_m + chord_m * std::cos(towards), from.y_m + chord_m * std::sin(towards), from.yaw_rad + turn_rad};
}

Route::Route(const TrajectorySpec& run) {
  double time_s = 0;
  Pose pose;
  bool placed = run.start.has_value();  // without a start the robot sets out facing its first goal
  if (run.start) {
    pose = *run.start;
  } else if (!run.waypoints.empty()) {
    pose = {run.waypoints[0].x_m, run.waypoints[0].y_m, 0};
  }
  const auto add = [&](const Motion& motion, const Pose& end) {
    legs_.push_back({time_s, pose, motion});
    time_s += motion.duration_s;
    pose = end;
  };
  for (const raycast::Point& goal : run.waypoints) {
    const double dx = goal.x_m - pose.x_m, dy = goal.y_m - pose.y_m, distance_m = std::hypot(dx, dy);
    if (distance_m == 0) continue;
    const double heading = std::atan2(dy, dx), turn = std::remainder(heading - pose.yaw_rad, 2 * std::numbers::pi);
    if (placed && turn != 0) {
      const double rate = turn < 0 ? -run.turn_rate_rad_s : run.turn_rate_rad_s;
      add({turn / rate, 0, rate}, pose);
    }
    placed = true;
    pose.yaw_rad = heading;
    add({distance_m / run.speed_m_s, run.speed_m_s, 0}, {goal.x_m, goal.y_m, heading});
  }
  for (const Motion& leg : run.legs)
    add(leg, advance(pose, leg.speed_m_s * leg.duration_s, leg.turn_rate_rad_s * leg.duration_s));
  legs_.push_back({time_s, pose, {}});
}

std::size_t Route::leg_at(double time_s) const {
  const auto after = std::upper_bound(legs_.begin(), legs_.end(), time_s,
                                      [](double time, const Leg& leg) { return time < leg.begin_s; });
  return after == legs_.begin() ? 0 : static_cast<std::size_t>(after - legs_.begin()) - 1;
}

Pose Route::at(double time_s) const {
  const Leg& leg = legs_[leg_at(time_s)];
  const double t = std::min(std::max(time_s - leg.begin_s, 0.0), leg.motion.duration_s);
  return advance(leg.start, leg.motion.speed_m_s * t, leg.motion.turn_rate_rad_s * t);
}

std::vector<Motion> Route::between(double from_s, double to_s) const {
  std::vector<Motion> motions;
  for (std::size_t i = leg_at(from_s); i < legs_.size() && legs_[i].begin_s < to_s; ++i) {
    const Leg& leg = legs_[i];
    const double begin_s = std::max(from_s, leg.begin_s), end_s = std::min(to_s, leg.begin_s + leg.motion.duration_s);
    if (end_s > begin_s) motions.push_back({end_s - begin_s, leg.motion.speed_m_s, leg.motion.turn_rate_rad_s});
  }
  return motions;
}

std::vector<Pose> drive(const TrajectorySpec& trajectory) {
  std::vector<Pose> poses;
  if (trajectory.waypoints.empty() && !trajectory.start) return poses;
  const Route route(trajectory);
  const auto steps = static_cast<std::size_t>(std::ceil(route.duration_s() / trajectory.period_s - 1e-9)) + 1;
  poses.reserve(steps);
  for (std::size_t i = 0; i < steps; ++i) poses.push_back(route.at(static_cast<double>(i) * trajectory.period_s));
  // The last period may be cut short: the run ends where it should.
  poses.back() = route.at(route.duration_s());
  return poses;
}

}  // namespace evigrid::scenes
