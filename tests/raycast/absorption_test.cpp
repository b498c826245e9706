// SPDX-License-Identifier: Apache-2.0
// Surfaces that absorb: heard up to max_range·√(1 − a), hiding beyond. By hand, and against the reference.
#include <gtest/gtest.h>

#include <stdexcept>

#include "both_indices.hpp"
#include "evigrid/raycast/reference.hpp"
#include "evigrid/raycast/scene.hpp"
#include "placed_world.hpp"

namespace evigrid::raycast {
namespace {

using namespace testing;

void expect(const World& world, const ConeQuery& q, double range_m) {
  const Echo fast = BothIndices(world).cast_cone(q), slow = reference_cone(world, q);
  if (std::isinf(range_m)) {
    EXPECT_EQ(fast.status, EchoStatus::none) << fast.range_m;
    EXPECT_EQ(slow.status, EchoStatus::none) << slow.range_m;
  } else {
    EXPECT_NEAR(fast.range_m, range_m, 1e-9);
    EXPECT_NEAR(slow.range_m, range_m, 1e-9);
  }
}

constexpr double kNone = INFINITY;
/// Heard up to half of the range.
constexpr Material kHalf{90 * kDegree, 0.75};
const ConeQuery kAhead{0, 0, 0, 20 * kDegree, 0.1, 4};

TEST(Absorption, HeardUpToItsShareOfTheRangeClosed) {
  for (double x : {1.0, 1.999, 2.0}) expect({.walls = {{{x, -5}, {x, 5}, kHalf}}}, kAhead, x);
  for (double x : {2.00001, 3.0}) expect({.walls = {{{x, -5}, {x, 5}, kHalf}}}, kAhead, kNone);
  expect({.circles = {{{2.5, 0}, 0.5, kHalf}}}, kAhead, 2);
  expect({.circles = {{{2.50001, 0}, 0.5, kHalf}}}, kAhead, kNone);
  expect({.walls = {{{2, 0}, {2, 0}, kHalf}}}, kAhead, 2);  // a post
  expect({.walls = {{{2.1, 0}, {2.1, 0}, kHalf}}}, kAhead, kNone);
}

TEST(Absorption, HidesBeyond) {
  const World w{.walls = {{{3, -5}, {3, 5}, kHalf}, {{3.5, -5}, {3.5, 5}, {}}}};
  expect(w, kAhead, kNone);
  // It covers the upper half only: the wall behind begins at its end.
  const World part{.walls = {{{3, 0}, {3, 5}, kHalf}, {{3.5, -5}, {3.5, 5}, {}}}};
  expect(part, kAhead, 3.5);
  const World most{.walls = {{{3, -0.3}, {3, 5}, kHalf}, {{3.5, -5}, {3.5, 5}, {}}}};
  expect(most, kAhead, 3.5 * std::hypot(1, 0.1));
}

TEST(Absorption, OnlyTheNearPartOfAWallIsHeard) {
  // The wall leads away: heard where it is within 2 m, not where the cone sees it only farther off.
  const World w{.walls = {{{1.5, -5}, {1.5, 5}, kHalf}}};
  const double end = std::acos(1.5 / 2) / kDegree;
  expect(w, {0, 0, (end + 5 - 0.01) * kDegree, 10 * kDegree, 0.1, 4}, 1.5 / std::cos((end - 0.01) * kDegree));
  expect(w, {0, 0, (end + 5 + 0.01) * kDegree, 10 * kDegree, 0.1, 4}, kNone);
  // The nearest part is covered by something silent: the rest is heard from the edge of that on, while within 2 m.
  const Material silent{0};
  for (double cover : {0.4, 1.2, 1.4}) {
    World c = w;
    c.walls.push_back({{1.2, -0.1}, {1.4, cover * 1.4 / 1.5}, silent});
    const double range = std::hypot(1.5, cover);
    expect(c, {0, 0, 45 * kDegree, 90 * kDegree, 0.1, 4}, range <= 2 ? range : kNone);
  }
}

TEST(Absorption, RoundRoomFromInside) {
  // Radius 3, sensor 2 m off the centre: the wall is 1 m behind and 5 m ahead; heard up to 2 m.
  const World w{.circles = {{{2, 0}, 3, kHalf}}};
  expect(w, {0, 0, 180 * kDegree, 20 * kDegree, 0.1, 4}, 1);
  expect(w, {0, 0, 0, 20 * kDegree, 0.1, 4}, kNone);
  // Law of cosines: the wall is 2 m away at 180° − acos((3² − 2² − 2²) / (2·2·2)).
  const double limit = 180 - std::acos(1.0 / 8) / kDegree;
  expect(w, {0, 0, (limit - 10 + 0.01) * kDegree, 20 * kDegree, 0.1, 4}, [&] {
    const double a = (limit + 0.01) * kDegree;
    return 2 * std::cos(a) + std::sqrt(9 - 4 * std::sin(a) * std::sin(a));
  }());
  expect(w, {0, 0, (limit - 10 - 0.01) * kDegree, 20 * kDegree, 0.1, 4}, kNone);
}

TEST(Absorption, LaserReadsNothing) {
  const World w{.walls = {{{3, -5}, {3, 5}, kHalf}, {{3.5, -5}, {3.5, 5}, {}}}};
  const BothIndices scene(w);
  for (double max : {5.9, 6.0, 7.0}) {
    const double expected = max < 6 ? kNone : 3;
    EXPECT_EQ(scene.ray_range(0, 0, 0, max), expected) << max;
    EXPECT_EQ(reference_ray(w, 0, 0, 0, max), expected) << max;
  }
}

TEST(Absorption, BadOnesAreRefusedByName) {
  for (double a : {-0.1, 1.0, 2.0, std::nan("")}) {
    try {
      BothIndices scene({.boxes = {{{0, 0}, 1, 1, 0, {1, a}}}});
      ADD_FAILURE() << a;
    } catch (const std::invalid_argument& e) {
      EXPECT_STREQ(e.what(), "box 0: absorption is outside [0, 1)");
    }
  }
}

TEST(Absorption, EqualsReferenceInRandomRooms) {
  Random r(21);
  int ok = 0, none = 0, changed = 0;
  for (int k = 0; k < 40; ++k) {
    const World plain = random_room(r);
    World world = plain;
    make_absorbing(world, r);
    if (k % 3 == 0) world.circles.push_back({{4, 3}, r.uniform(1, 4), {r.uniform(0, 1.5), r.uniform(0, 0.95)}});
    const BothIndices scene(world), unabsorbed(plain);
    for (int c = 0; c < 60; ++c) {
      const ConeQuery q = random_cone(r);
      const Echo expected = reference_cone(world, q), got = scene.cast_cone(q);
      ASSERT_EQ(static_cast<int>(got.status), static_cast<int>(expected.status)) << k << " " << c << " " << got.range_m;
      if (expected.status != EchoStatus::none) {
        ASSERT_NEAR(got.range_m, expected.range_m, 1e-8) << k << " " << c;
      }
      ok += expected.status == EchoStatus::ok;
      none += expected.status == EchoStatus::none;
      changed += got.range_m != unabsorbed.cast_cone(q).range_m;
      const double x = q.x_m, y = q.y_m, a = q.yaw_rad, max = q.max_range_m;
      const double ray = reference_ray(world, x, y, a, max);
      ASSERT_EQ(std::isinf(scene.ray_range(x, y, a, max)), std::isinf(ray)) << k << " " << c;
      if (!std::isinf(ray)) {
        ASSERT_NEAR(scene.ray_range(x, y, a, max), ray, 1e-9) << k << " " << c;
      }
    }
  }
  EXPECT_GT(ok, 500);
  EXPECT_GT(none, 250);
  EXPECT_GT(changed, 250);
}

}  // namespace
}  // namespace evigrid::raycast
