// SPDX-License-Identifier: Apache-2.0
#include "evigrid/scenes/live.hpp"

#include <algorithm>
#include <cmath>

#include "evigrid/scenes/simulate.hpp"
#include "hearing.hpp"
#include "odometry.hpp"
#include "reading.hpp"

namespace evigrid::scenes {
namespace {

constexpr double kPiece_m = 0.01;  // of a way, tested as a straight line

}  // namespace

LiveRobot::LiveRobot(const Floor& floor, const raycast::Scene& caster, Scene robot, const Pose& start)
    : robot_(std::move(robot)), floor_(&floor), caster_(&caster), pose_(start), believed_(start) {}

Sensed LiveRobot::sense(raycast::Scene::Placements movers) {
  Sensed out;
  std::vector<raycast::ConeQuery> cones;
  for (const SonarSpec& sonar : robot_.sonars) cones.push_back(query(sonar, compose(pose_, sonar.T_robot_sensor)));
  std::vector<raycast::Echo> echoes(cones.size());
  hear(*caster_, robot_, cones, echoes, movers);
  const std::uint64_t seed = robot_.trajectory.seed, step = sensed_++;
  std::uint32_t sensor = 0;
  for (std::size_t i = 0; i < cones.size(); ++i)
    out.ranges_m.push_back(reading(echoes[i], robot_.sonars[i], {seed, 0, sensor++, step}));
  for (const LaserSpec& laser : robot_.lasers) {
    std::vector<double> ranges_m(static_cast<std::size_t>(laser.beams));
    caster_->cast_fan(query(laser, compose(pose_, laser.T_robot_sensor)), ranges_m, movers);
    const raycast::NoiseKey key{seed, 0, sensor++, step};
    for (std::uint32_t beam = 0; beam < ranges_m.size(); ++beam)
      out.beams_m.push_back(reading(echo_of(ranges_m[beam], laser), laser, key, beam));
  }
  return out;
}

Moved LiveRobot::move(double turn_rad, double way_m) {
  Moved out;
  if (turn_rad != 0) out = move(Motion{std::abs(turn_rad), 0, std::copysign(1.0, turn_rad)});
  if (way_m != 0) {
    const Moved straight = move(Motion{std::abs(way_m), std::copysign(1.0, way_m), 0});
    out.way_m = straight.way_m;
    out.stopped = straight.stopped;
  }
  return out;
}

Moved LiveRobot::move(const Motion& motion) {
  const double all_m = motion.speed_m_s * motion.duration_s;
  const auto pieces = static_cast<std::int64_t>(std::ceil(std::abs(all_m) / kPiece_m));
  const auto part = [&](std::int64_t i) {  // of the way and the turn, i of all pieces
    return pieces == 0 ? 1.0 : static_cast<double>(i) / static_cast<double>(pieces);
  };
  const Pose from = pose_;
  double driven = 1;
  for (std::int64_t i = 1; i <= pieces; ++i) {
    const Pose next = advance(from, all_m * part(i), motion.turn_rate_rad_s * motion.duration_s * part(i));
    if (!floor_->drives({pose_.x_m, pose_.y_m}, {next.x_m, next.y_m}, robot_.radius_m)) {
      driven = part(i - 1);
      break;
    }
    pose_ = next;
  }
  Motion done = motion;
  done.duration_s *= driven;
  const double turn_rad = done.turn_rate_rad_s * done.duration_s;
  if (pieces == 0) pose_ = advance(from, 0, turn_rad);
  believed_ = robot_.odometry.used
                  ? believed_after(believed_, done, robot_.odometry, robot_.trajectory.seed, ++moved_, 0)
                  : advance(believed_, all_m * driven, turn_rad);
  way_m_ += std::abs(all_m) * driven;
  return {all_m * driven, turn_rad, driven < 1};
}

}  // namespace evigrid::scenes
