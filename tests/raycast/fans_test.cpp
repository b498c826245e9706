// SPDX-License-Identifier: Apache-2.0
// Fans in packets against single rays and against the reference; many cones and fans at once against one call each.
#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

#include "both_indices.hpp"
#include "evigrid/raycast/reference.hpp"
#include "evigrid/raycast/scene.hpp"
#include "placed_world.hpp"

namespace evigrid::raycast {
namespace {

using namespace testing;

double angle_of(const FanQuery& q, int i) { return q.yaw_rad + q.first_rad + i * q.step_rad; }

void expect_equal(const World& all, const BothIndices& scene, const FanQuery& q, const std::vector<Placement>& at,
                  double tolerance_m) {
  std::vector<double> ranges_m(static_cast<std::size_t>(q.beams), -1);
  scene.cast_fan(q, ranges_m, at);
  for (int i = 0; i < q.beams; ++i) {
    const double fan = ranges_m[static_cast<std::size_t>(i)];
    const double single = scene.ray_range(q.x_m, q.y_m, angle_of(q, i), q.max_range_m, at);
    const double expected = reference_ray(all, q.x_m, q.y_m, angle_of(q, i), q.max_range_m);
    ASSERT_EQ(std::isinf(fan), std::isinf(single)) << "beam " << i << ": " << fan << ", " << single;
    ASSERT_EQ(std::isinf(fan), std::isinf(expected)) << "beam " << i << ": " << fan << ", " << expected;
    if (std::isinf(fan)) continue;
    ASSERT_NEAR(fan, single, tolerance_m) << "beam " << i;
    ASSERT_NEAR(fan, expected, tolerance_m) << "beam " << i;
  }
}

FanQuery random_fan(Random& r) {
  const double steps[5] = {0.25 * kDegree, 1 * kDegree, -0.5 * kDegree, 11 * kDegree, 2.5};
  FanQuery q{r.uniform(0.1, 7.9), r.uniform(0.1, 5.9), r.uniform(-7, 7), r.uniform(-3, 3),
             steps[r.below(5)],   1 + r.below(80),     r.uniform(1, 12)};
  return q;
}

TEST(Fans, EqualSingleRaysAndReference) {
  Random r(41);
  for (int k = 0; k < 30; ++k) {
    World fixed = random_room(r);
    std::vector<World> shapes = random_movers(r);
    if (k % 2) make_absorbing(fixed, r);
    const BothIndices scene(fixed, shapes);
    for (int c = 0; c < 20; ++c) {
      std::vector<Placement> at;
      for (std::size_t i = 0; i < shapes.size(); ++i) at.push_back(random_placement(r));
      expect_equal(with(fixed, shapes, at), scene, random_fan(r), at, 1e-9);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Fans, EqualOnAlignedScenes) {
  // Rays along walls, through joints and ends, from walls, at round numbers.
  Random r(42);
  const auto lattice = [&](int n) { return 0.5 * r.below(2 * n + 1); };
  for (int k = 0; k < 40; ++k) {
    World w;
    w.polygons.push_back({{{0, 0}, {6, 0}, {6, 4}, {0, 4}}, {}});
    for (int i = 0; i < 5; ++i) {
      const Point from{lattice(6), lattice(4)};
      w.walls.push_back({from, r.below(2) ? Point{lattice(6), from.y_m} : Point{from.x_m, lattice(4)}, {}});
    }
    w.boxes.push_back({{lattice(6), lattice(4)}, 1, 0.5, 0, {}});
    w.circles.push_back({{lattice(6), lattice(4)}, 0.23, {}});
    const BothIndices scene(w);
    for (int c = 0; c < 10; ++c) {
      // Not from a wall: what a ray along it meets first is a matter of rounding there.
      const FanQuery q{lattice(5) + 0.125, lattice(3) + 0.125, 0, 0, 15 * kDegree, 24, 5};
      expect_equal(w, scene, q, {}, 1e-9);
      const FanQuery straight{lattice(5) + 0.125, lattice(3) + 0.125, 0, 0, 90 * kDegree, 4, 5};
      expect_equal(w, scene, straight, {}, 1e-9);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Fans, RangeLimitIsClosedAndEdgeOnWallsAreMet) {
  const World w{.walls = {{{5, -5}, {5, 5}, {}}, {{2, 1}, {3, 1}, {}}}};
  const BothIndices scene(w);
  double range[3];
  scene.cast_fan({0, 0, -0.3, 0, 0.3, 3, 5}, range);
  EXPECT_TRUE(std::isinf(range[0]) && std::isinf(range[2]));
  EXPECT_EQ(range[1], 5);
  scene.cast_fan({0, 1, -0.3, 0, 0.3, 3, 5}, range);
  EXPECT_NEAR(range[1], 2, 1e-12) << "the wall on edge";
}

TEST(Fans, FromFarAway) {
  Random r(43);
  const World world = random_room(r);
  const BothIndices scene(world);
  for (int c = 0; c < 20; ++c) {
    const double towards = r.uniform(-3, 3), x = 4 - 1000 * std::cos(towards), y = 3 - 1000 * std::sin(towards);
    expect_equal(world, scene, {x, y, towards, -0.004, 0.0002, 41, 2000}, {}, 1e-7);
  }
}

TEST(Fans, NoBeamsAndBadOnes) {
  const BothIndices scene(World{});
  scene.cast_fan({.beams = 0}, {});
  std::vector<double> ten(10);
  EXPECT_THROW(scene.cast_fan({.beams = 9, .max_range_m = 1}, ten), std::invalid_argument);
  EXPECT_THROW(scene.cast_fan({.beams = -1, .max_range_m = 1}, {}), std::invalid_argument);
  EXPECT_THROW(scene.cast_fan({.step_rad = INFINITY, .beams = 10, .max_range_m = 1}, ten), std::invalid_argument);
  EXPECT_THROW(scene.cast_fan({.beams = 10, .max_range_m = -1}, ten), std::invalid_argument);
  scene.cast_fan({.beams = 10, .max_range_m = 1}, ten);
  for (double range : ten) EXPECT_TRUE(std::isinf(range));
}

TEST(Many, SameBitsForAnyNumberOfThreads) {
  Random r(44);
  const World fixed = random_room(r);
  const std::vector<World> shapes = random_movers(r);
  const BothIndices scene(fixed, shapes);
  std::vector<Placement> at;
  for (std::size_t i = 0; i < shapes.size(); ++i) at.push_back(random_placement(r));
  std::vector<ConeQuery> cones;
  for (int i = 0; i < 2000; ++i) cones.push_back(random_cone(r));
  std::vector<FanQuery> fans;
  std::size_t beams = 0;
  for (int i = 0; i < 100; ++i) {
    fans.push_back(random_fan(r));
    beams += static_cast<std::size_t>(fans.back().beams);
  }
  std::vector<double> alone;
  for (const FanQuery& q : fans) {
    std::vector<double> ranges_m(static_cast<std::size_t>(q.beams));
    scene.cast_fan(q, ranges_m, at);
    alone.insert(alone.end(), ranges_m.begin(), ranges_m.end());
  }
  for (int threads : {0, 1, 2, 7}) {
    std::vector<Echo> echoes(cones.size());
    scene.cast_cones(cones, echoes, at, threads);
    for (std::size_t i = 0; i < cones.size(); ++i) {
      const Echo one = scene.cast_cone(cones[i], at);
      ASSERT_EQ(one.status, echoes[i].status) << threads << " " << i;
      ASSERT_EQ(std::memcmp(&one.range_m, &echoes[i].range_m, sizeof one.range_m), 0) << threads << " " << i;
    }
    std::vector<double> ranges_m(beams);
    scene.cast_fans(fans, ranges_m, at, threads);
    ASSERT_EQ(std::memcmp(ranges_m.data(), alone.data(), beams * sizeof(double)), 0) << threads;
  }
}

TEST(Many, BadCallsLeaveTheAnswersAlone) {
  const BothIndices scene(World{});
  std::vector<ConeQuery> queries(3, {0, 0, 0, 0.2, 0, 1});
  std::vector<Echo> echoes(3, {EchoStatus::ok, 7});
  EXPECT_THROW(scene.cast_cones(queries, {echoes.data(), 2}), std::invalid_argument);
  EXPECT_THROW(scene.cast_cones(queries, echoes, {}, -1), std::invalid_argument);
  queries[2].aperture_rad = 4;
  EXPECT_THROW(scene.cast_cones(queries, echoes, {}, 2), std::invalid_argument);
  for (const Echo& e : echoes) EXPECT_EQ(e.range_m, 7);
}

}  // namespace
}  // namespace evigrid::raycast
