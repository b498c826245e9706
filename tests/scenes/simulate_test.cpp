// SPDX-License-Identifier: Apache-2.0
// The driver's poses and the simulated ranges against numbers worked out by hand.
#include "evigrid/scenes/simulate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

namespace evigrid::scenes {
namespace {

constexpr double kPi = std::numbers::pi;

void expect_pose(const Pose& p, double x_m, double y_m, double yaw_rad) {
  EXPECT_NEAR(p.x_m, x_m, 1e-12);
  EXPECT_NEAR(p.y_m, y_m, 1e-12);
  EXPECT_NEAR(std::remainder(p.yaw_rad - yaw_rad, 2 * kPi), 0, 1e-12);
}

TEST(Drive, TurnsOnTheSpotThenGoesStraight) {
  // 1 m ahead at 1 m/s, a quarter turn left at 90°/s, 0.55 m up.
  const auto poses = drive({{{0, 0}, {1, 0}, {1, 0.55}}, 1, kPi / 2, 0.1, 0});
  ASSERT_EQ(poses.size(), 27u);  // 2.55 s: the last step is the end of the run
  expect_pose(poses[0], 0, 0, 0);
  expect_pose(poses[3], 0.3, 0, 0);
  expect_pose(poses[10], 1, 0, 0);
  expect_pose(poses[15], 1, 0, kPi / 4);
  expect_pose(poses[20], 1, 0, kPi / 2);
  expect_pose(poses[24], 1, 0.4, kPi / 2);
  expect_pose(poses[26], 1, 0.55, kPi / 2);
}

TEST(Drive, TakesTheShorterWayRound) {
  const auto poses = drive({{{0, 0}, {-1, 0.1}, {-2, 0}}, 1, 1, 0.1, 0});
  double turned = 0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    turned += std::abs(std::remainder(poses[i].yaw_rad - poses[i - 1].yaw_rad, 2 * kPi));
  EXPECT_NEAR(turned, 2 * std::atan(0.1), 1e-9);
}

TEST(Drive, OneWaypointIsOnePose) {
  const auto poses = drive({{{3, 4}}, 1, 1, 0.1, 0});
  ASSERT_EQ(poses.size(), 1u);
  expect_pose(poses[0], 3, 4, 0);
  EXPECT_EQ(drive({{{3, 4}, {3, 4}}, 1, 1, 0.1, 0}).size(), 1u);
}

TEST(Compose, IsTheFieldsConvention) { expect_pose(compose({1, 2, kPi / 2}, {3, 0, kPi / 4}), 1, 5, 3 * kPi / 4); }

/// A box of 4 × 3 m around a robot with four sonars at its rim, facing along and across.
Scene in_a_box() {
  Scene s;
  s.world.polygons.push_back({{{0, 0}, {4, 0}, {4, 3}, {0, 3}}, {}});
  for (int i = 0; i < 4; ++i) {
    const double bearing = i * kPi / 2;
    SonarSpec sonar;
    sonar.T_robot_sensor = {0.2 * std::cos(bearing), 0.2 * std::sin(bearing), bearing};
    sonar.aperture_rad = 20 * kPi / 180;
    sonar.min_range_m = 0.15;
    sonar.max_range_m = 2.5;
    s.sonars.push_back(sonar);
  }
  s.trajectory = {{{1, 1}, {2, 1}, {2, 1.25}}, 1, kPi / 2, 0.25, 5};
  return s;
}

TEST(Simulate, RangesByHand) {
  const Scene s = in_a_box();
  const raycast::Scene caster(s.world);
  const auto steps = simulate(s, caster);
  ASSERT_EQ(steps.size(), 10u);
  // At (1, 1) facing +x: walls at 3, 2, 1, 1 m from the centre, less the 0.2 m of the rim; 2.8 m is not heard.
  const float none = INFINITY;
  EXPECT_EQ(steps[0].stamp_ns, 0);
  EXPECT_EQ(steps[0].ranges_m, (std::vector<float>{none, 1.8f, 0.8f, 0.8f}));
  EXPECT_EQ(steps[2].stamp_ns, 500000000);
  const std::vector<float> at_half{2.3f, 1.8f, 1.3f, 0.8f};  // (1.5, 1)
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(steps[2].ranges_m[i], at_half[i], 1e-6);
  // The end: (2, 1.25) facing +y.
  EXPECT_EQ(steps[9].stamp_ns, 2250000000);
  const std::vector<float> at_end{1.55f, 1.8f, 1.05f, 1.8f};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(steps[9].ranges_m[i], at_end[i], 1e-6);
}

TEST(Simulate, TooCloseAndSlantedWalls) {
  Scene s = in_a_box();
  s.trajectory.waypoints = {{0.3, 1}};  // facing +x: the sonar behind is 0.1 m from the wall
  const raycast::Scene caster(s.world);
  EXPECT_EQ(simulate(s, caster)[0].ranges_m[2], -INFINITY);
  s.trajectory.waypoints = {{1, 1}, {2, 2}};  // facing 45°: sonar 0 sees both far walls at their nearer cone edge
  const Step step = simulate(s, caster)[0];
  const double rim = 1 + 0.2 * std::sqrt(0.5), edge = 35 * kPi / 180;  // 45° − 10° off the normal
  EXPECT_NEAR(step.ranges_m[0], (3 - rim) / std::cos(edge), 1e-6);
  EXPECT_NEAR(step.ranges_m[1], rim > 1 ? (1 - 0.2 * std::sqrt(0.5)) / std::cos(edge) : 0, 1e-6);
}

TEST(Simulate, NoiseIsKeyedNotDrawn) {
  Scene s = in_a_box();
  for (SonarSpec& sonar : s.sonars) sonar.noise = {0.02, 0.01};
  const raycast::Scene caster(s.world);
  const auto first = simulate(s, caster), second = simulate(s, caster);
  const Simulation simulation(s, caster);
  for (std::size_t i = first.size(); i-- > 0;) {  // backwards: no hidden state
    EXPECT_EQ(first[i].ranges_m, second[i].ranges_m);
    EXPECT_EQ(simulation.step(i).ranges_m, first[i].ranges_m);
  }
  EXPECT_EQ(first[0].ranges_m[1], static_cast<float>(raycast::noisy(1.8, {0.02, 0.01}, {5, 0, 1, 0})));
  EXPECT_NE(first[0].ranges_m[2], first[0].ranges_m[3]);  // same distance, another key
  s.trajectory.seed = 6;
  EXPECT_NE(simulate(s, caster)[0].ranges_m, first[0].ranges_m);
}

}  // namespace
}  // namespace evigrid::scenes
