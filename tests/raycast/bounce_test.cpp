// SPDX-License-Identifier: Apache-2.0
// Second bounces: ways known by hand, and all of them by brute force.
#include <gtest/gtest.h>

#include <stdexcept>

#include "both_indices.hpp"
#include "evigrid/raycast/scene.hpp"
#include "flat_rays.hpp"
#include "placed_world.hpp"

namespace evigrid::raycast {
namespace {

using namespace testing;

const Material kMirror{20 * kDegree};

ConeQuery cone(double yaw_deg, double aperture_deg, double max_m = 8) {
  return {0, 0, yaw_deg * kDegree, aperture_deg * kDegree, 0.1, max_m};
}

TEST(SecondBounce, MirrorAndBox) {
  // A mirror at 45° two metres ahead turns the ray upwards to a box three metres above: the reading is 2 + 3, where the
  // sonar stands before free space as far as it knows.
  const World w{.walls = {{{1, -1}, {3, 1}, kMirror}}, .boxes = {{{2, 3.5}, 2, 1, 0, {}}}};
  const BothIndices scene(w);
  const ConeQuery ray = cone(0, 0);
  EXPECT_EQ(scene.cast_cone(ray).status, EchoStatus::none);
  const Echo echo = scene.cast_cone_second_bounce(ray, {}, 1);
  EXPECT_EQ(echo.status, EchoStatus::ok);
  EXPECT_NEAR(echo.range_m, 5, 1e-12);
  // A cone sees the box's face y = 3 in the mirror as x = 5 behind it... straight ahead it is nearest.
  EXPECT_NEAR(scene.cast_cone_second_bounce(cone(0, 10), {}, 33).range_m, 5, 1e-12);
  EXPECT_GE(scene.cast_cone_second_bounce(cone(0, 10), {}, 32).range_m, 5);
  EXPECT_NEAR(scene.cast_cone_second_bounce(cone(0, 10), {}, 32).range_m, 5, 1e-3);
  // Not heard any more, too close, and not before a direct echo.
  EXPECT_EQ(scene.cast_cone_second_bounce(cone(0, 0, 4.99), {}, 1).status, EchoStatus::none);
  EXPECT_EQ(scene.cast_cone_second_bounce(cone(0, 0, 5), {}, 1).status, EchoStatus::ok);
  ConeQuery late = ray;
  late.min_range_m = 6;
  EXPECT_EQ(scene.cast_cone_second_bounce(late, {}, 1).status, EchoStatus::too_close);
  World with_post = w;
  with_post.circles.push_back({{1.5, 0.05}, 0.01, {}});
  EXPECT_NEAR(BothIndices(with_post).cast_cone_second_bounce(cone(0, 10), {}, 33).range_m, std::hypot(1.5, 0.05) - 0.01,
              1e-12);
}

TEST(SecondBounce, CornerOfTwoWalls) {
  // Walls x = 2 and y = 5, both silent beyond 45°. Towards 60° the first is met at 60° and throws the sound to the
  // second, which meets it at 30° and sends it back. Mirrored in the first wall the sonar stands at (4, 0).
  const Material half{45 * kDegree};
  const World w{.walls = {{{2, -9}, {2, 5}, half}, {{2, 5}, {-9, 5}, half}}};
  const BothIndices scene(w);
  EXPECT_NEAR(scene.cast_cone_second_bounce(cone(60, 0), {}, 1).range_m, 5 / std::sin(60 * kDegree), 1e-12);
  EXPECT_NEAR(scene.cast_cone_second_bounce(cone(60, 10), {}, 32).range_m, 5 / std::sin(65 * kDegree), 1e-12);
  // Both beyond their critical incidence: the second throws it away as well.
  const World shinier{.walls = {{{2, -9}, {2, 5}, {25 * kDegree}}, {{2, 5}, {-9, 5}, {25 * kDegree}}}};
  EXPECT_EQ(BothIndices(shinier).cast_cone_second_bounce(cone(60, 0), {}, 1).status, EchoStatus::none);
  // Straight into the corner: the ray ends there.
  EXPECT_FALSE(scene.cast_cone_second_bounce({0, 3, 45 * kDegree, 0, 0.1, 8}, {}, 1).range_m > 3);
}

TEST(SecondBounce, BothSurfacesAbsorbTheMirrorTwice) {
  // (1 − 0.2) · √(1 − 0.36) = 0.64: way 5 is heard from a range of 7.8125 on.
  const World w{.walls = {{{1, -1}, {3, 1}, {20 * kDegree, 0.2}}}, .boxes = {{{2, 3.5}, 2, 1, 0, {2 * kDegree, 0.36}}}};
  EXPECT_EQ(BothIndices(w).cast_cone_second_bounce(cone(0, 0, 7.8126), {}, 1).status, EchoStatus::ok);
  EXPECT_EQ(BothIndices(w).cast_cone_second_bounce(cone(0, 0, 7.8124), {}, 1).status, EchoStatus::none);
}

TEST(SecondBounce, RoundMirrors) {
  // From outside: a pole of radius 1 met at 45° of its normal turns the ray by 90°.
  const double s = std::sqrt(0.5);
  World w{.walls = {{{-5, 4}, {9, 4}, {}}}, .circles = {{{3 + s, -s}, 1, kMirror}}};
  EXPECT_NEAR(BothIndices(w).cast_cone_second_bounce(cone(0, 0), {}, 1).range_m, 3 + 4, 1e-12);
  // From inside: the same wall is met again after one chord, 2·cos(incidence)·r, at the same incidence. Sent back only
  // by a box in the way.
  w = {.boxes = {{{0, 1.2}, 6, 0.4, 0, {}}}, .circles = {{{0, 0}, 2, {30 * kDegree}}}};
  const double x = 2 * s;  // meets the circle at (x, -x), 45° from its normal, and goes up
  EXPECT_NEAR(BothIndices(w).cast_cone_second_bounce({-1, -x, 0, 0, 0.1, 8}, {}, 1).range_m, x + 1 + x + 1, 1e-12);
  w.boxes.clear();
  EXPECT_EQ(BothIndices(w).cast_cone_second_bounce({-1, -x, 0, 0, 0.1, 8}, {}, 1).status, EchoStatus::none);
}

TEST(SecondBounce, MoversMirrorAndAreMirrored) {
  const World mirror{.walls = {{{-1, 0}, {1, 0}, kMirror}}}, box{.boxes = {{{0, 0}, 2, 1, 0, {}}}};
  const std::vector<World> shapes{mirror, box};
  const BothIndices scene({}, shapes);
  const std::vector<Placement> at{{2, 0, 45 * kDegree}, {2, 3.5, 180 * kDegree}};
  EXPECT_NEAR(scene.cast_cone_second_bounce(cone(0, 0), at, 1).range_m, 5, 1e-12);
  EXPECT_EQ(scene.cast_cone_second_bounce(cone(0, 0), {}, 1).status, EchoStatus::none);
}

TEST(SecondBounce, EqualsBruteForce) {
  Random r(51);
  int bounced = 0, cones = 0, off = 0;
  for (int k = 0; k < 12; ++k) {
    World fixed = random_room(r);
    const std::vector<World> shapes = random_movers(r);
    if (k % 2) make_absorbing(fixed, r);
    std::vector<Placement> at;
    for (std::size_t i = 0; i < shapes.size(); ++i) at.push_back(random_placement(r));
    const BothIndices scene(fixed, shapes);
    const FlatRays flat(with(fixed, shapes, at));
    for (int c = 0; c < 25; ++c, ++cones) {
      ConeQuery q = random_cone(r);
      q.min_range_m = 0;
      const int few = 32, many = 31 * 60 + 1;
      const double direct = scene.cast_cone(q, at).range_m;
      const double expected = std::min(direct, flat.second_bounce(q, many));
      const double got = scene.cast_cone_second_bounce(q, at, many).range_m;
      ASSERT_EQ(std::isinf(got), std::isinf(expected)) << k << " " << c << ": " << got << " instead of " << expected;
      if (!std::isinf(got)) {
        ASSERT_NEAR(got, expected, 1e-7) << k << " " << c;
      }
      // Fewer directions, among which the others are: never shorter.
      const double coarse = scene.cast_cone_second_bounce(q, at, few).range_m;
      ASSERT_GE(coarse, got - 1e-9) << k << " " << c;
      ASSERT_LE(coarse, direct) << k << " " << c;
      bounced += got < direct;
      off += coarse > got + 0.05;
    }
  }
  EXPECT_GT(bounced, cones / 20);
  RecordProperty("cones_with_a_second_bounce", bounced);
  RecordProperty("off_5cm_with_32_rays", off);
}

TEST(SecondBounce, NeedsARay) {
  EXPECT_THROW((void)BothIndices(World{}).cast_cone_second_bounce(cone(0, 0), {}, 0), std::invalid_argument);
}

}  // namespace
}  // namespace evigrid::raycast
