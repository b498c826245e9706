// SPDX-License-Identifier: Apache-2.0
// Cones by buckets and by Embree where it might matter which surfaces are proposed: large worlds, walls along the
// borders of buckets, cones of every width and range, rings, movers, materials. BothIndices compares bit by bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "both_indices.hpp"
#include "evigrid/raycast/reference.hpp"
#include "placed_world.hpp"

namespace evigrid::raycast {
namespace {

using namespace testing;

World field(Random& r, int walls, double extent_m, bool materials) {
  World w;
  for (int i = 0; i < walls; ++i) {
    const Point from{r.uniform(0, extent_m), r.uniform(0, extent_m)};
    const double angle = r.uniform(0, 6.3), size = i % 500 == 0 ? 40 : r.uniform(0, 1);
    w.walls.push_back({from,
                       {from.x_m + size * std::cos(angle), from.y_m + size * std::sin(angle)},
                       materials ? any_material(r) : Material{}});
    if (i % 20 == 0)
      w.circles.push_back({{r.uniform(0, extent_m), r.uniform(0, extent_m)}, r.uniform(0, 0.5), any_material(r)});
  }
  return w;
}

/// 24 cones around a pose, each from a place of its own.
std::vector<ConeQuery> ring(Random& r, Point at, double aperture_rad, double max_range_m) {
  std::vector<ConeQuery> all;
  const double yaw = r.uniform(-3, 3), radius = r.uniform(0, 0.4);
  for (int i = 0; i < 24; ++i) {
    const double bearing = yaw + i * 15 * kDegree;
    all.push_back({at.x_m + radius * std::cos(bearing), at.y_m + radius * std::sin(bearing), bearing, aperture_rad, 0.1,
                   max_range_m});
  }
  return all;
}

TEST(Indices, SameBitsAmong20000Walls) {
  Random r(41);
  for (bool materials : {false, true}) {
    const BothIndices scene(field(r, 20000, 100, materials));
    int heard = 0;
    for (int i = 0; i < 3000; ++i) {
      const double aperture = i % 5 == 0 ? 0 : i % 5 == 1 ? 3 : r.uniform(0, 0.7);
      const double range = i % 7 == 0 ? 300 : r.uniform(0, 8);
      const Echo e = scene.cast_cone({r.uniform(-5, 105), r.uniform(-5, 105), r.uniform(-4, 4), aperture, 0, range});
      heard += e.status == EchoStatus::ok;
    }
    EXPECT_GT(heard, 1500);
  }
}

TEST(Indices, ManyConesAtOnceEqualOneByOne) {
  Random r(42);
  const World world = field(r, 4000, 40, true);
  std::vector<World> shapes;
  std::vector<Placement> at;
  for (int i = 0; i < 10; ++i)
    for (World& s : random_movers(r)) {
      make_absorbing(s, r);
      shapes.push_back(s);
      at.push_back({r.uniform(0, 40), r.uniform(0, 40), r.uniform(-3, 3)});
    }
  const BothIndices scene(world, shapes);
  std::vector<ConeQuery> queries;
  for (int pose = 0; pose < 60; ++pose) {
    const Point p{r.uniform(0, 40), r.uniform(0, 40)};
    for (const ConeQuery& q : ring(r, p, r.uniform(0.1, 0.6), r.uniform(1, 10))) queries.push_back(q);
    if (pose % 3 == 0) queries.push_back({r.uniform(0, 40), r.uniform(0, 40), r.uniform(-3, 3), 0.3, 0.1, 4});
  }
  std::vector<Echo> alone;
  for (const ConeQuery& q : queries) alone.push_back(scene.cast_cone(q, at));
  for (int threads : {1, 2, 0}) {
    std::vector<Echo> together(queries.size());
    scene.cast_cones(queries, together, at, threads);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      ASSERT_EQ(static_cast<int>(together[i].status), static_cast<int>(alone[i].status)) << i;
      ASSERT_EQ(together[i].range_m, alone[i].range_m) << i;
    }
  }
  // In another order no ring is whole.
  std::vector<ConeQuery> mixed(queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) mixed[i] = queries[i * 7 % queries.size()];
  ASSERT_NE(queries.size() % 7, 0u);
  std::vector<Echo> together(queries.size());
  scene.cast_cones(mixed, together, at);
  for (std::size_t i = 0; i < queries.size(); ++i)
    ASSERT_EQ(together[i].range_m, alone[i * 7 % queries.size()].range_m);
}

TEST(Indices, WallsAndSensorsOnTheBordersOfBuckets) {
  // Whatever size a bucket has, some of these borders, corners and tips lie on a multiple of it.
  World w;
  for (int i = 0; i <= 32; ++i) {
    w.walls.push_back({{i * 0.5, i % 3 * 0.25}, {i * 0.5, 16.0}, {}});
    w.walls.push_back({{0, i * 0.5}, {i % 5 + 0.5, i * 0.5}, {}});
    w.walls.push_back({{i * 0.5, i * 0.5}, {i * 0.5, i * 0.5}, {}});  // posts
    w.circles.push_back({{i * 0.5, 8}, 0, {}});
  }
  const BothIndices scene(w);
  for (int i = 0; i < 2000; ++i) {
    const ConeQuery q{i % 33 * 0.5 + 0.25 * (i % 2),
                      i / 33 % 33 * 0.5,
                      i % 8 * 45 * kDegree,
                      i % 3 * 15 * kDegree,
                      0,
                      i % 4 * 2.0 + 0.5};
    const Echo got = scene.cast_cone(q);
    if (i % 20 != 0) continue;
    const Echo expected = reference_cone(w, q);
    ASSERT_EQ(static_cast<int>(got.status), static_cast<int>(expected.status)) << i;
    if (expected.status != EchoStatus::none) {
      ASSERT_NEAR(got.range_m, expected.range_m, 1e-8) << i;
    }
  }
}

TEST(Indices, FarFromTheOriginAndFarFromTheWorld) {
  Random r(43);
  World w = field(r, 2000, 60, true);
  for (Wall& wall : w.walls)
    for (Point* p : {&wall.from, &wall.to}) *p = {p->x_m + 432100.25, p->y_m + 5412345.5};
  for (Circle& c : w.circles) c.centre = {c.centre.x_m + 432100.25, c.centre.y_m + 5412345.5};
  const BothIndices scene(w);
  for (int i = 0; i < 2000; ++i) {
    const double off = i % 4 == 0 ? 1000 : 0;
    (void)scene.cast_cone({432100.25 + r.uniform(-off, 60 + off), 5412345.5 + r.uniform(-off, 60 + off),
                           r.uniform(-4, 4), r.uniform(0, 1), 0, i % 4 == 0 ? 2000.0 : r.uniform(0, 9)});
  }
  for (double range : {0.0, 1e-12, 1e6, 1e30, 1e300}) (void)scene.cast_cone({432130.25, 5412375.5, 1, 0.5, 0, range});
}

TEST(Indices, AutomaticTakesBucketsUnlessTheWallsCrowd) {
  Random r(44);
  EXPECT_EQ(Scene(field(r, 3000, 50, false)).index(), Index::buckets);
  EXPECT_EQ(Scene(random_room(r)).index(), Index::buckets);
  EXPECT_EQ(Scene(World{}).index(), Index::buckets);
  World crowd = field(r, 3000, 1, false);
  crowd.walls.push_back({{1e5, 1e5}, {1e5 + 1, 1e5}, {}});
  EXPECT_EQ(Scene(crowd).index(), Index::embree);
  const BothIndices scene(crowd);
  for (int i = 0; i < 300; ++i)
    (void)scene.cast_cone({r.uniform(-1, 2), r.uniform(-1, 2), r.uniform(-3, 3), r.uniform(0, 0.5), 0, 3});
}

}  // namespace
}  // namespace evigrid::raycast
