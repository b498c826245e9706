// SPDX-License-Identifier: Apache-2.0
// Fleets: robots drive on ways of their own and never through or into anything, and every number depends on seed, robot
// and step alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

#include "evigrid/raycast/reference.hpp"
#include "evigrid/scenes/building.hpp"
#include "evigrid/scenes/fleet.hpp"
#include "evigrid/scenes/simulate.hpp"

namespace evigrid::scenes {
namespace {

/// Work items in reverse, on two threads.
void on_threads(std::size_t count, const std::function<void(std::size_t)>& work) {
  const auto half = [&](std::size_t parity) {
    for (std::size_t i = count; i-- > 0;)
      if (i % 2 == parity) work(i);
  };
  std::thread other([&] { half(1); });
  half(0);
  other.join();
}

Scene robot_named(const std::string& name) {
  Scene robot;
  use_robot(robot, name);
  return robot;
}

struct Place {
  raycast::World world;
  Floor floor;
  raycast::Scene caster;
  explicit Place(double side_m, std::uint64_t seed = 4)
      : world(make_building({.width_m = side_m, .depth_m = side_m, .seed = seed})), floor(world), caster(world) {}
};

/// Distance from a point to the outline of a box, and whether it is inside: by the box's own axes.
double distance_to(const raycast::Box& b, double x, double y, bool& inside) {
  const double c = std::cos(b.yaw_rad), s = std::sin(b.yaw_rad), dx = x - b.centre.x_m, dy = y - b.centre.y_m;
  const double u = std::abs(c * dx + s * dy) - b.length_m / 2, v = std::abs(c * dy - s * dx) - b.width_m / 2;
  inside = u <= 0 && v <= 0;
  if (inside) return -std::max(u, v);
  return std::hypot(std::max(u, 0.0), std::max(v, 0.0));
}

TEST(Fleet, RobotsKeepTheirDistanceFromEverythingAndGoSomewhere) {
  const Place place(30);
  const Scene robot = robot_named("hughes24");
  FleetSpec spec{.robots = 20, .seed = 9, .period_s = 0.2};
  Fleet fleet(place.floor, place.caster, robot, spec);
  constexpr std::size_t kSteps = 400;
  std::vector<Pose> poses(spec.robots * kSteps);
  fleet.drive(0, poses);
  double way_m = 0;
  int left_the_room = 0;
  for (std::size_t r = 0; r < spec.robots; ++r) {
    double farthest_m = 0;
    for (std::size_t i = 0; i < kSteps; ++i) {
      const Pose& p = poses[i * spec.robots + r];
      ASSERT_GT(std::min(p.x_m, p.y_m), 0);
      ASSERT_LT(std::max(p.x_m, p.y_m), 30);
      for (const raycast::Box& b : place.world.boxes) {
        bool inside = false;
        const double d = distance_to(b, p.x_m, p.y_m, inside);
        ASSERT_FALSE(inside) << r << ' ' << i;
        ASSERT_GE(d, robot.radius_m + spec.margin_m - 1e-6) << r << ' ' << i;
      }
      for (const raycast::Circle& c : place.world.circles)
        ASSERT_GE(std::hypot(p.x_m - c.centre.x_m, p.y_m - c.centre.y_m),
                  c.radius_m + robot.radius_m + spec.margin_m - 1e-6);
      farthest_m = std::max(farthest_m, std::hypot(p.x_m - poses[r].x_m, p.y_m - poses[r].y_m));
      if (i == 0) continue;
      const Pose& q = poses[(i - 1) * spec.robots + r];
      const double step_m = std::hypot(p.x_m - q.x_m, p.y_m - q.y_m);
      way_m += step_m;
      ASSERT_LE(step_m, spec.speed_m_s * spec.period_s + 1e-9);  // no jumps
      ASSERT_LE(std::abs(std::remainder(p.yaw_rad - q.yaw_rad, 2 * 3.14159265358979)),
                spec.turn_rate_rad_s * spec.period_s + 1e-6);
      if (step_m == 0) continue;
      ASSERT_FALSE(place.caster.ray_range(q.x_m, q.y_m, std::atan2(p.y_m - q.y_m, p.x_m - q.x_m), step_m) < step_m);
    }
    left_the_room += farthest_m > 7.1 ? 1 : 0;  // the diagonal of a room
  }
  EXPECT_GT(way_m / static_cast<double>(spec.robots), 0.5 * spec.speed_m_s * spec.period_s * kSteps);
  EXPECT_GT(left_the_room, 5);
}

TEST(Fleet, NumbersDoNotDependOnHowTheyAreAskedFor) {
  const Place place(20);
  const Scene robot = robot_named("asharif8x8");  // sonars and lasers
  const FleetSpec spec{.robots = 7, .seed = 3, .period_s = 0.3};
  Fleet whole(place.floor, place.caster, robot, spec), parts(place.floor, place.caster, robot, spec, on_threads);
  const std::size_t n = 7 * 60, per = whole.ranges_per_scan();
  EXPECT_EQ(per, 16u);
  std::vector<Pose> poses(n), again(n);
  std::vector<float> ranges(n * per), more(n * per);
  whole.drive(0, poses);
  whole.measure(0, poses, ranges);
  std::size_t at = 0;
  for (const std::size_t count : {1, 5, 1, 20, 100, 7, 200}) {
    parts.drive(at, std::span(again).subspan(at, count), on_threads);
    parts.measure(at, std::span(again).subspan(at, count), std::span(more).subspan(at * per, count * per), on_threads);
    at += count;
  }
  for (std::size_t i = 0; i < at; ++i) {
    ASSERT_EQ(poses[i].x_m, again[i].x_m) << i;
    ASSERT_EQ(poses[i].yaw_rad, again[i].yaw_rad) << i;
  }
  for (std::size_t i = 0; i < at * per; ++i) ASSERT_EQ(ranges[i], more[i]) << i;
  EXPECT_EQ(whole.stamp_ns(6), 0);
  EXPECT_EQ(whole.stamp_ns(15), 600000000);
}

TEST(Fleet, MeasuresWhatOneCasterCallSays) {
  const Place place(20);
  Scene robot = robot_named("asharif8x8");
  for (SonarSpec& s : robot.sonars) s.noise = {};
  for (LaserSpec& l : robot.lasers) l.noise = {};
  Fleet fleet(place.floor, place.caster, robot, {.robots = 11, .seed = 2});
  std::vector<Pose> poses(44);
  std::vector<float> ranges(44 * 16);
  fleet.drive(0, poses);
  fleet.measure(0, poses, ranges);
  int echoes = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t k = 0; k < robot.sonars.size(); ++k) {
      const SonarSpec& s = robot.sonars[k];
      const Pose p = compose(poses[i], s.T_robot_sensor);
      const raycast::Echo echo =
          place.caster.cast_cone({p.x_m, p.y_m, p.yaw_rad, s.aperture_rad, s.min_range_m, s.max_range_m});
      const float range = ranges[i * 16 + k];
      if (echo.status == raycast::EchoStatus::ok) {
        ASSERT_NEAR(range, echo.range_m, 1e-6);
        ++echoes;
      } else {
        ASSERT_TRUE(std::isinf(range));
        ASSERT_EQ(range > 0, echo.status == raycast::EchoStatus::none);
      }
    }
    for (std::size_t k = 0; k < robot.lasers.size(); ++k) {
      const LaserSpec& l = robot.lasers[k];
      const Pose p = compose(poses[i], l.T_robot_sensor);
      const double expected = place.caster.ray_range(p.x_m, p.y_m, p.yaw_rad + l.first_rad, l.max_range_m);
      const float range = ranges[i * 16 + robot.sonars.size() + k];
      if (expected > l.max_range_m) {
        ASSERT_EQ(range, std::numeric_limits<float>::infinity());
      } else if (expected > l.min_range_m) {
        ASSERT_NEAR(range, expected, 1e-6);
      }
    }
  }
  EXPECT_GT(echoes, 100);
}

TEST(Fleet, PlacesOutsideOfThingsAndRefusesWhereThereIsNoRoom) {
  const Place place(20);
  for (const raycast::Box& b : place.world.boxes) EXPECT_FALSE(place.floor.stands(b.centre, 0.01));
  for (const raycast::Circle& c : place.world.circles) EXPECT_FALSE(place.floor.stands(c.centre, 0.01));
  Scene robot = robot_named("hughes24");
  robot.radius_m = 4;
  EXPECT_THROW(Fleet(place.floor, place.caster, robot, {.robots = 1}, on_threads), std::invalid_argument);
}

}  // namespace
}  // namespace evigrid::scenes
