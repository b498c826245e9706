// SPDX-License-Identifier: Apache-2.0
// Lasers against rays cast by brute force, noise by beam, the same numbers for every number of threads, and what second
// bounce and cross-talk change.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "evigrid/raycast/reference.hpp"
#include "evigrid/scenes/simulate.hpp"

namespace evigrid::scenes {
namespace {

constexpr double kPi = std::numbers::pi;

/// The furnished room with two lasers beside the sonars, one of them crooked, and a person who crosses it.
Scene room(bool with_person) {
  Scene s = parse_scene(default_scene_text(), "default");
  LaserSpec wide;
  wide.T_robot_sensor = {0.1, 0.05, 0.2};
  wide.first_rad = -kPi / 2;
  wide.step_rad = kPi / 180;
  wide.beams = 181;
  wide.min_range_m = 1;
  wide.max_range_m = 6;
  LaserSpec narrow = wide;
  narrow.T_robot_sensor = {-0.1, 0, kPi};
  narrow.first_rad = 0;
  narrow.beams = 3;
  narrow.max_range_m = 30;
  s.lasers = {wide, narrow};
  if (with_person) {
    MoverSpec person;
    person.shape.circles = {{{0, 0.1}, 0.08, {}}, {{0, -0.1}, 0.08, {}}};
    person.trajectory.waypoints = {{3, 4}, {4, 6}, {3, 4}};
    person.loop = true;
    s.movers = {person};
  }
  return s;
}

bool same(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(Lasers, EveryBeamIsTheFirstSurface) {
  const Scene s = room(false);
  const raycast::Scene caster = make_caster(s);
  const Simulation run(s, caster);
  std::size_t finite = 0, near = 0;
  for (std::size_t i = 0; i < run.steps(); i += 40) {
    const Step step = run.step(i);
    ASSERT_EQ(step.ranges_m.size(), 24u);
    ASSERT_EQ(step.beams_m.size(), 184u);
    std::size_t k = 0;
    for (const LaserSpec& laser : s.lasers) {
      const Pose p = compose(step.T_map_robot, laser.T_robot_sensor);
      for (int b = 0; b < laser.beams; ++b, ++k) {
        const double angle = p.yaw_rad + laser.first_rad + b * laser.step_rad;
        const double truth = raycast::reference_ray(s.world, p.x_m, p.y_m, angle, laser.max_range_m);
        const float got = step.beams_m[k];
        if (truth < laser.min_range_m) {
          EXPECT_EQ(got, -INFINITY);
          ++near;
        } else if (std::isinf(truth)) {
          EXPECT_EQ(got, INFINITY);
        } else {
          EXPECT_NEAR(got, truth, 2e-6);
          ++finite;
        }
      }
    }
  }
  EXPECT_GT(finite, 2000u);
  EXPECT_GT(near, 10u);
}

TEST(Lasers, EveryBeamHasNoiseOfItsOwn) {
  Scene exact = room(false), noisy = exact;
  for (LaserSpec& laser : noisy.lasers) laser.noise = {0.02, 0.01};
  const raycast::Scene caster = make_caster(exact);
  const Simulation truth(exact, caster), run(noisy, caster);
  double sum = 0, sum2 = 0, neighbours = 0, last = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < run.steps(); i += 3) {
    const Step a = truth.step(i), b = run.step(i);
    EXPECT_TRUE(same(a.ranges_m, b.ranges_m));  // the sonars have not noticed
    for (std::size_t k = 0; k < 181; ++k) {
      if (!std::isfinite(a.beams_m[k]) || !std::isfinite(b.beams_m[k]) || a.beams_m[k] > 5 || a.beams_m[k] < 1.2)
        continue;
      const double z = (b.beams_m[k] - a.beams_m[k]) / (0.02 + 0.01 * a.beams_m[k]);
      sum += z;
      sum2 += z * z;
      neighbours += z * last;
      last = z;
      ++n;
    }
    const double by_hand = raycast::noisy(a.beams_m[90], {0.02, 0.01}, {exact.trajectory.seed, 0, 24, i}, 90);
    if (std::isfinite(b.beams_m[90])) {
      EXPECT_NEAR(b.beams_m[90], by_hand, 1e-6);
    }
  }
  const double root = std::sqrt(static_cast<double>(n));
  ASSERT_GT(n, 10000u);
  EXPECT_NEAR(sum / static_cast<double>(n), 0, 4 / root);
  EXPECT_NEAR(sum2 / static_cast<double>(n), 1, 6 / root);
  EXPECT_NEAR(neighbours / static_cast<double>(n), 0, 4 / root);
}

TEST(Threads, TheSameNumbersForAnyNumber) {
  for (const bool with_person : {false, true}) {
    Scene s = room(with_person);
    for (LaserSpec& laser : s.lasers) laser.noise = {0.01, 0};
    s.odometry = {true, 0.3, 0.01, 0, 0.005};
    const raycast::Scene caster = make_caster(s);
    const Simulation run(s, caster);
    const std::vector<Step> one = run.run(0, run.steps(), 1);
    for (const int threads : {0, 2, 7}) {
      const std::vector<Step> many = run.run(0, run.steps(), threads);
      ASSERT_EQ(many.size(), one.size());
      for (std::size_t i = 0; i < one.size(); ++i) {
        ASSERT_TRUE(same(one[i].ranges_m, many[i].ranges_m)) << i;
        ASSERT_TRUE(same(one[i].beams_m, many[i].beams_m)) << i;
        ASSERT_EQ(one[i].T_odom_robot.x_m, many[i].T_odom_robot.x_m);
      }
    }
    for (const std::size_t i : {std::size_t{300}, std::size_t{17}}) {  // one alone, and a stretch in the middle
      EXPECT_TRUE(same(run.step(i).beams_m, one[i].beams_m));
      EXPECT_TRUE(same(run.run(i, 3, 2)[1].ranges_m, one[i + 1].ranges_m));
    }
  }
}

TEST(Echoes, SecondBounceOnlyEverAddsReadings) {
  Scene plain = room(false), bouncing = plain;
  plain.lasers.clear();
  bouncing.lasers.clear();
  bouncing.echo.second_bounce = true;
  const raycast::Scene caster = make_caster(plain);
  const Simulation a(plain, caster), b(bouncing, caster);
  std::size_t added = 0;
  for (std::size_t i = 0; i < a.steps(); i += 5) {
    const Step once = a.step(i), twice = b.step(i);
    for (std::size_t k = 0; k < once.ranges_m.size(); ++k) {
      EXPECT_LE(twice.ranges_m[k], once.ranges_m[k]);  // a first echo is never lost or later
      added += std::isinf(once.ranges_m[k]) && std::isfinite(twice.ranges_m[k]);
    }
  }
  EXPECT_GT(added, 50u);
}

TEST(Echoes, CrossTalkHappensWithinAGroupOnly) {
  // Two sonars side by side before a wall, the second one looking away from it into the open: what it hears is the
  // first one's sound, by half the way first → wall → second.
  Scene s;
  s.world.walls = {{{-10, 2}, {10, 2}, {}}};
  SonarSpec ahead;
  ahead.T_robot_sensor = {-0.2, 0, kPi / 2};
  ahead.aperture_rad = 0.6;
  ahead.max_range_m = 5;
  SonarSpec beside = ahead;
  beside.T_robot_sensor = {0.2, 0, kPi / 2};
  s.sonars = {ahead, beside};
  s.trajectory.waypoints = {{0, 0}};
  const raycast::Scene caster = make_caster(s);
  const auto ranges = [&] { return simulate(s, caster)[0].ranges_m; };
  EXPECT_NEAR(ranges()[1], 2, 1e-6);
  s.sonars[1].T_robot_sensor.yaw_rad = kPi / 2 - 0.35;  // sees the wall at its edge 0.05 rad off the normal: 2/cos(.05)
  EXPECT_NEAR(ranges()[1], 2 / std::cos(0.05), 1e-6);
  s.echo.cross_talk = true;
  const float alone = 2.0F / std::cos(0.05F);
  EXPECT_LE(ranges()[1], alone + 1e-6F);
  EXPECT_GT(ranges()[1], 1.99F);  // never shorter than the half way between them: √(2² + 0.2²) less the apex offset
  const std::vector<float> together = ranges();
  s.sonars[1].group = 1;
  EXPECT_NEAR(ranges()[1], alone, 1e-6);
  EXPECT_NEAR(ranges()[0], 2, 1e-6);
  EXPECT_EQ(together.size(), 2u);
}

TEST(Step, BelievedPoseIsTheTrueOneWithoutOdometry) {
  const Scene s = room(false);
  const raycast::Scene caster = make_caster(s);
  const Step step = Simulation(s, caster).step(100);
  EXPECT_EQ(step.T_odom_robot.x_m, step.T_map_robot.x_m);
  EXPECT_EQ(step.T_odom_robot.yaw_rad, step.T_map_robot.yaw_rad);
}

}  // namespace
}  // namespace evigrid::scenes
