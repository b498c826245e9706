// SPDX-License-Identifier: Apache-2.0
// Wheel odometry of a differential drive. Left and right wheel go v ∓ ω·track/2 per second; each reports its way
// scaled by its drift, with noise whose standard deviation is noise · √way: independent pieces of a way add up to the
// same distribution, however it is cut. What they report is integrated as arcs, as a robot does.
#include "odometry.hpp"

#include <cmath>
#include <limits>

#include "evigrid/scenes/simulate.hpp"

namespace evigrid::scenes {
namespace {

// Keys of the two wheels, out of the way of all sensors' numbers.
constexpr std::uint32_t kLeftWheel = std::numeric_limits<std::uint32_t>::max() - 1, kRightWheel = kLeftWheel + 1;

}  // namespace

Pose believed_after(const Pose& believed, const Motion& m, const OdometrySpec& odometry, std::uint64_t seed,
                    std::uint64_t step, std::uint32_t piece) {
  const auto reported_m = [&](double way_m, double drift, std::uint32_t wheel) {
    const double sigma_m = odometry.noise_m_per_sqrt_m * std::sqrt(std::abs(way_m));
    return way_m * (1 + drift) + sigma_m * raycast::gaussian({seed, 0, wheel, step}, piece);
  };
  const double apart_m_s = m.turn_rate_rad_s * odometry.track_m / 2;
  const double left_m = reported_m((m.speed_m_s - apart_m_s) * m.duration_s, odometry.drift_left, kLeftWheel);
  const double right_m = reported_m((m.speed_m_s + apart_m_s) * m.duration_s, odometry.drift_right, kRightWheel);
  return advance(believed, (left_m + right_m) / 2, (right_m - left_m) / odometry.track_m);
}

std::vector<Pose> dead_reckoning(const TrajectorySpec& trajectory, const OdometrySpec& odometry) {
  std::vector<Pose> poses = drive(trajectory);
  const Route route(trajectory);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double from_s = static_cast<double>(i - 1) * trajectory.period_s;
    const double to_s = i + 1 == poses.size() ? route.duration_s() : static_cast<double>(i) * trajectory.period_s;
    Pose pose = poses[i - 1];
    std::uint32_t piece = 0;
    for (const Motion& m : route.between(from_s, to_s))
      pose = believed_after(pose, m, odometry, trajectory.seed, i, piece++);
    poses[i] = pose;
  }
  return poses;
}

}  // namespace evigrid::scenes
