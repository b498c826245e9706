// SPDX-License-Identifier: Apache-2.0
// The caster against the reference, which shares neither Embree nor the candidates with it.
#include <gtest/gtest.h>

#include "both_indices.hpp"
#include "evigrid/raycast/reference.hpp"
#include "evigrid/raycast/scene.hpp"
#include "random_world.hpp"

namespace evigrid::raycast {
namespace {

using namespace testing;

struct Tally {
  int ok = 0, none = 0, too_close = 0;
};

/// Compares `cones` answers in each of `worlds` worlds, moved by `shift`.
Tally compare(int worlds, int cones, std::uint64_t seed, Point shift, double tolerance_m) {
  Tally tally;
  Random r(seed);
  for (int k = 0; k < worlds; ++k) {
    World world = random_room(r);
    const auto move = [&](Point& p) { p = {p.x_m + shift.x_m, p.y_m + shift.y_m}; };
    for (Wall& w : world.walls) move(w.from), move(w.to);
    for (Box& b : world.boxes) move(b.centre);
    for (Circle& c : world.circles) move(c.centre);
    for (Polygon& p : world.polygons)
      for (Point& v : p.vertices) move(v);
    const BothIndices scene(world);
    for (int c = 0; c < cones; ++c) {
      ConeQuery q = random_cone(r);
      q.x_m += shift.x_m;
      q.y_m += shift.y_m;
      const Echo expected = reference_cone(world, q), got = scene.cast_cone(q);
      EXPECT_EQ(static_cast<int>(got.status), static_cast<int>(expected.status))
          << "world " << k << " cone " << c << ": " << got.range_m << " instead of " << expected.range_m;
      if (expected.status != EchoStatus::none) {
        EXPECT_NEAR(got.range_m, expected.range_m, tolerance_m) << "world " << k << " cone " << c;
      }
      tally.ok += expected.status == EchoStatus::ok;
      tally.none += expected.status == EchoStatus::none;
      tally.too_close += expected.status == EchoStatus::too_close;
    }
  }
  return tally;
}

TEST(CastCone, EqualsReferenceInRandomRooms) {
  const Tally t = compare(60, 100, 1, {}, 1e-8);
  EXPECT_GT(t.ok, 2000);
  EXPECT_GT(t.none, 300);
  EXPECT_GT(t.too_close, 100);
}

TEST(CastCone, EqualsReferenceFarFromTheOrigin) {
  // UTM-like coordinates: double keeps 1e-10 m there, float would keep half a metre.
  compare(10, 100, 2, {432100.25, 5412345.5}, 1e-5);
}

TEST(CastCone, RoundRoomSeenFromInside) {
  Random r(3);
  for (int k = 0; k < 20; ++k) {
    World world;
    world.circles.push_back({{4, 3}, r.uniform(1, 5), any_material(r)});
    for (int i = 0; i < 3; ++i)
      world.circles.push_back({{r.uniform(0, 8), r.uniform(0, 6)}, r.uniform(0.1, 2), any_material(r)});
    const BothIndices scene(world);
    for (int c = 0; c < 100; ++c) {
      const ConeQuery q = random_cone(r);
      const Echo expected = reference_cone(world, q), got = scene.cast_cone(q);
      ASSERT_EQ(static_cast<int>(got.status), static_cast<int>(expected.status)) << k << " " << c;
      if (expected.status != EchoStatus::none) {
        ASSERT_NEAR(got.range_m, expected.range_m, 1e-8) << k << " " << c;
      }
    }
  }
}

TEST(RayRange, EqualsReference) {
  Random r(4);
  for (int k = 0; k < 20; ++k) {
    const World world = random_room(r);
    const BothIndices scene(world);
    for (int c = 0; c < 200; ++c) {
      const double x = r.uniform(-3, 11), y = r.uniform(-3, 9), angle = r.uniform(-4, 4), max = r.uniform(0.5, 20);
      const double expected = reference_ray(world, x, y, angle, max), got = scene.ray_range(x, y, angle, max);
      ASSERT_EQ(std::isinf(got), std::isinf(expected));
      if (!std::isinf(expected)) {
        ASSERT_NEAR(got, expected, 1e-9);
      }
    }
    // From a kilometre away, towards the middle of the room.
    for (int c = 0; c < 20; ++c) {
      const double angle = r.uniform(-3, 3), x = 4 - 1000 * std::cos(angle), y = 3 - 1000 * std::sin(angle);
      ASSERT_NEAR(scene.ray_range(x, y, angle, 2000), reference_ray(world, x, y, angle, 2000), 1e-7);
    }
  }
}

}  // namespace
}  // namespace evigrid::raycast
