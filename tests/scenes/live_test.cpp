// SPDX-License-Identifier: Apache-2.0
// A robot that decides as it goes measures and believes what a simulated run along the same way does; walls stop it.
#include "evigrid/scenes/live.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "evigrid/scenes/simulate.hpp"

namespace {

using namespace evigrid::scenes;

constexpr const char* kText = R"(
name = "live"
[map]
cell_m = 0.1
rule = "dempster"
[[world.polygons]]
vertices = [[0, 0], [6, 0], [6, 4], [0, 4]]
[[world.boxes]]
centre = [4, 2]
length_m = 1
width_m = 1
[robot]
radius_m = 0.25
[robot.odometry]
drift_left = 0.01
noise_m_per_sqrt_m = 0.02
[robot.ring]
count = 8
radius_m = 0.2
[robot.sensor]
model = "li2014"
aperture_deg = 20
min_range_m = 0.1
max_range_m = 5
noise_sigma_m = 0.02
[[robot.laser]]
x_m = 0.1
y_m = 0
yaw_deg = 0
beams = 19
first_deg = -90
step_deg = 10
max_range_m = 8
noise_sigma_m = 0.01
[trajectory]
start = [1, 1, 0]
velocity = [
  { duration_s = 1, speed_m_s = 1 },
  { duration_s = 1, speed_m_s = 0, turn_rate_deg_s = 80 },
  { duration_s = 1, speed_m_s = 0.8, turn_rate_deg_s = 20 },
]
period_s = 1
seed = 5
)";

Scene scene() {
  Scene s = parse_scene(kText, "live");
  return s;
}

TEST(LiveRobot, MeasuresAndBelievesWhatASimulatedRunDoes) {
  const Scene s = scene();
  const auto caster = make_caster(s);
  const Floor floor(s.world);
  const auto steps = simulate(s, caster);
  const Route route(s.trajectory);
  LiveRobot robot(floor, caster, s, *s.trajectory.start);
  ASSERT_EQ(steps.size(), 4u);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Sensed got = robot.sense();
    EXPECT_EQ(got.ranges_m, steps[i].ranges_m) << i;
    EXPECT_EQ(got.beams_m, steps[i].beams_m) << i;
    EXPECT_NEAR(robot.believed().x_m, steps[i].T_odom_robot.x_m, 1e-12) << i;
    EXPECT_NEAR(robot.believed().yaw_rad, steps[i].T_odom_robot.yaw_rad, 1e-12) << i;
    if (i + 1 == steps.size()) break;
    EXPECT_FALSE(robot.move(s.trajectory.legs[i]).stopped);
  }
}

TEST(LiveRobot, StopsBeforeItTouchesAWall) {
  Scene s = scene();
  s.odometry = {};
  const auto caster = make_caster(s);
  const Floor floor(s.world);
  LiveRobot robot(floor, caster, s, {1, 2, 0});
  const Moved moved = robot.move(0, 5);  // the box begins at x = 3.5
  EXPECT_TRUE(moved.stopped);
  EXPECT_NEAR(robot.pose().x_m, 3.25, 0.011);
  EXPECT_LE(robot.pose().x_m, 3.25);
  EXPECT_EQ(robot.pose().x_m, robot.believed().x_m);
  EXPECT_TRUE(robot.move(0, 1).stopped);
  EXPECT_FALSE(robot.move(std::acos(-1.0), 1).stopped);
  EXPECT_NEAR(robot.pose().x_m, 2.25, 0.011);
  EXPECT_NEAR(robot.way_m(), 2.25 + 1, 0.02);
}

}  // namespace
