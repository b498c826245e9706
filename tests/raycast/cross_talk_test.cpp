// SPDX-License-Identifier: Apache-2.0
// Cross-talk: ways known by hand, the same in both directions, and all of them by brute force.
#include <gtest/gtest.h>

#include <stdexcept>

#include "both_indices.hpp"
#include "evigrid/raycast/scene.hpp"
#include "flat_rays.hpp"
#include "placed_world.hpp"

namespace evigrid::raycast {
namespace {

using namespace testing;

ConeQuery sonar(double x, double y, double yaw_deg, double aperture_deg, double max_m = 5) {
  return {x, y, yaw_deg * kDegree, aperture_deg * kDegree, 0.1, max_m};
}

TEST(CrossTalk, OverAWall) {
  // Both two metres before the wall and a metre apart: the shortest way meets it in the middle, where it is mirrored.
  const double way = std::hypot(0.5, 2), towards = std::atan2(2, 0.5) / kDegree;
  const ConeQuery a = sonar(0, 0, towards, 20), b = sonar(1, 0, 180 - towards, 20);
  for (double critical_deg : {90.0, 20.0, 1e-6}) {
    const BothIndices scene({.walls = {{{-5, 2}, {5, 2}, {critical_deg * kDegree}}}});
    EXPECT_NEAR(scene.cross_talk(a, b, {}, 33).range_m, way, 1e-12) << critical_deg;
    EXPECT_NEAR(scene.cross_talk(b, a, {}, 33).range_m, way, 1e-12) << critical_deg;
  }
  const BothIndices scene({.walls = {{{-5, 2}, {5, 2}, {}}}});
  EXPECT_EQ(scene.cross_talk(a, sonar(1, 0, towards + 90, 20)).status, EchoStatus::none) << "looks elsewhere";
  EXPECT_EQ(scene.cross_talk(sonar(0, 0, 20, 20), b).status, EchoStatus::none) << "the speaker looks elsewhere";
  EXPECT_EQ(scene.cross_talk(a, sonar(1, 0, 180 - towards, 20, 2), {}, 33).status, EchoStatus::none) << "too far";
  EXPECT_EQ(scene.cross_talk(sonar(0, 0, towards, 20, 2), b, {}, 33).status, EchoStatus::none) << "too quiet";
  ConeQuery late = b;
  late.min_range_m = 3;
  EXPECT_EQ(scene.cross_talk(a, late, {}, 33).status, EchoStatus::too_close);
}

TEST(CrossTalk, MirroredAwayWhereTheBisectorIsNotNearTheNormal) {
  // Both look at the point (0, 2) of the wall from the same side, at 30° and 60° from its normal: the bisector is at
  // 45°.
  const ConeQuery a = sonar(2 * std::tan(30 * kDegree), 0, 120, 0), b = sonar(2 * std::tan(60 * kDegree), 0, 150, 0);
  const double way = (2 / std::cos(30 * kDegree) + 2 / std::cos(60 * kDegree)) / 2;
  for (double critical_deg : {44.0, 46.0}) {
    const BothIndices scene({.walls = {{{-5, 2}, {5, 2}, {critical_deg * kDegree}}}});
    for (const auto& [speaker, listener] : {std::pair(a, b), std::pair(b, a)}) {
      const Echo heard = scene.cross_talk(speaker, listener, {}, 1);
      EXPECT_EQ(heard.status, critical_deg > 45 ? EchoStatus::ok : EchoStatus::none) << critical_deg;
      if (heard.status == EchoStatus::ok) {
        EXPECT_NEAR(heard.range_m, way, 1e-9);
      }
    }
  }
}

TEST(CrossTalk, NothingInBetween) {
  const double towards = std::atan2(2, 0.5) / kDegree;
  const ConeQuery a = sonar(0, 0, towards, 20), b = sonar(1, 0, 180 - towards, 20);
  const World wall{.walls = {{{-5, 2}, {5, 2}, {}}}};
  const World screen{.walls = {{{-0.5, 0}, {0.5, 0}, {}}}};
  const BothIndices scene(wall, {&screen, 1});
  for (const auto& [speaker, listener] : {std::pair(a, b), std::pair(b, a)}) {
    const Placement before_a{0.1, 1, 0}, turned_away{0.5, 1, 90 * kDegree}, gone{0, 9, 0};
    EXPECT_EQ(scene.cross_talk(speaker, listener, {&before_a, 1}, 33).status, EchoStatus::none);
    EXPECT_EQ(scene.cross_talk(speaker, listener, {&gone, 1}, 33).status, EchoStatus::ok);
    EXPECT_EQ(scene.cross_talk(speaker, listener, {&turned_away, 1}, 33).status, EchoStatus::ok);
  }
  // From the other side of a wall nothing comes through.
  EXPECT_EQ(BothIndices(wall).cross_talk(sonar(0, 4, -90, 60), b).status, EchoStatus::none);
}

TEST(CrossTalk, AbsorbedOnce) {
  const double way = std::hypot(0.5, 2), towards = std::atan2(2, 0.5) / kDegree;
  const BothIndices scene({.walls = {{{-5, 2}, {5, 2}, {1, 0.75}}}});  // heard up to half of the range
  for (double share : {0.9999, 1.0001}) {
    const ConeQuery a = sonar(0, 0, towards, 20, 2 * way * share), b = sonar(1, 0, 180 - towards, 20, 2 * way * share);
    EXPECT_EQ(scene.cross_talk(a, b, {}, 33).status, share > 1 ? EchoStatus::ok : EchoStatus::none);
  }
}

TEST(CrossTalk, OneSonarInBothRolesHearsItsEcho) {
  Random r(61);
  int ok = 0;
  for (int k = 0; k < 10; ++k) {
    const World world = random_room(r);
    const BothIndices scene(world);
    for (int c = 0; c < 40; ++c) {
      ConeQuery q = random_cone(r);
      q.min_range_m = 0;
      const double exact = scene.cast_cone(q).range_m, sampled = scene.cross_talk(q, q, {}, 2000).range_m;
      ASSERT_GE(sampled, exact - 1e-9) << k << " " << c;
      ok += sampled < exact + 0.01 || std::isinf(exact);
    }
  }
  EXPECT_GT(ok, 380);
}

TEST(CrossTalk, EqualsBruteForceAndBothWays) {
  Random r(62);
  int heard = 0, pairs = 0, one_way = 0;
  for (int k = 0; k < 12; ++k) {
    World fixed = random_room(r);
    const std::vector<World> shapes = random_movers(r);
    if (k % 2) make_absorbing(fixed, r);
    std::vector<Placement> at;
    for (std::size_t i = 0; i < shapes.size(); ++i) at.push_back(random_placement(r));
    const BothIndices scene(fixed, shapes);
    const FlatRays flat(with(fixed, shapes, at));
    for (int c = 0; c < 25; ++c, ++pairs) {
      ConeQuery a = random_cone(r), b = a;
      b.x_m += r.uniform(-0.5, 0.5);
      b.y_m += r.uniform(-0.5, 0.5);
      b.yaw_rad += r.uniform(-0.6, 0.6);
      a.min_range_m = b.min_range_m = 0;
      const int few = 32, many = 31 * 60 + 1;
      const double expected = flat.cross_talk(a, b, many), got = scene.cross_talk(a, b, at, many).range_m;
      ASSERT_EQ(std::isinf(got), std::isinf(expected)) << k << " " << c << ": " << got << " instead of " << expected;
      if (!std::isinf(got)) {
        ASSERT_NEAR(got, expected, 1e-7) << k << " " << c;
      }
      ASSERT_GE(scene.cross_talk(a, b, at, few).range_m, got - 1e-9);
      heard += !std::isinf(got);
      // The other way round, sampled in other directions.
      const double back = scene.cross_talk(b, a, at, many).range_m;
      if (std::isinf(back) != std::isinf(got))
        ++one_way;
      else if (!std::isinf(back))
        one_way += std::abs(back - got) > 0.01;
    }
  }
  EXPECT_GT(heard, pairs / 5);
  EXPECT_LE(one_way, pairs / 50);
}

TEST(CrossTalk, BadQuestionsAreRefused) {
  const BothIndices scene(World{});
  const ConeQuery good = sonar(0, 0, 0, 20), bad = sonar(0, 0, 0, 200);
  EXPECT_THROW((void)scene.cross_talk(bad, good), std::invalid_argument);
  EXPECT_THROW((void)scene.cross_talk(good, bad), std::invalid_argument);
  EXPECT_THROW((void)scene.cross_talk(good, good, {}, 0), std::invalid_argument);
}

}  // namespace
}  // namespace evigrid::raycast
