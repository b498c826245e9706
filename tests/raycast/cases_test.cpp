// SPDX-License-Identifier: Apache-2.0
// Answers known by hand: thin poles, silent surfaces that hide, too close, no echo, degenerate shapes, bad questions.
#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <limits>
#include <stdexcept>

#include "both_indices.hpp"
#include "evigrid/raycast/reference.hpp"
#include "evigrid/raycast/scene.hpp"
#include "random_world.hpp"

namespace evigrid::raycast {
namespace {

using testing::BothIndices;

using testing::kDegree;

ConeQuery cone(double x, double y, double yaw_deg, double aperture_deg = 15, double min = 0.1, double max = 5) {
  return {x, y, yaw_deg * kDegree, aperture_deg * kDegree, min, max};
}

/// Both casters must give this answer.
void expect(const World& world, const ConeQuery& q, EchoStatus status, double range_m) {
  const Echo fast = BothIndices(world).cast_cone(q), slow = reference_cone(world, q);
  EXPECT_EQ(static_cast<int>(fast.status), static_cast<int>(status)) << "caster: " << fast.range_m;
  EXPECT_EQ(static_cast<int>(slow.status), static_cast<int>(status)) << "reference: " << slow.range_m;
  if (status == EchoStatus::none) {
    EXPECT_EQ(fast.range_m, std::numeric_limits<double>::infinity());
  } else {
    EXPECT_NEAR(fast.range_m, range_m, 1e-9);
    EXPECT_NEAR(slow.range_m, range_m, 1e-9);
  }
}

constexpr Material kShiny{10 * kDegree};

TEST(Cases, EmptyWorld) { expect({}, cone(0, 0, 0), EchoStatus::none, 0); }

TEST(Cases, WallAhead) {
  const World w{.walls = {{{2, -5}, {2, 5}, {}}}};
  expect(w, cone(0, 0, 0), EchoStatus::ok, 2);
  expect(w, cone(0, 0, 180), EchoStatus::none, 0);
  expect(w, cone(0, 0, 0, 15, 0.1, 2), EchoStatus::ok, 2);  // closed at the far end
  expect(w, cone(0, 0, 0, 15, 0.1, 1.999999), EchoStatus::none, 0);
  expect(w, cone(0, 0, 0, 15, 2, 5), EchoStatus::ok, 2);  // and at the near one
  expect(w, cone(0, 0, 0, 15, 2.000001, 5), EchoStatus::too_close, 2);
  expect(w, cone(0, 0, 45, 30), EchoStatus::ok, 2 / std::cos(30 * kDegree));  // the edge of the cone nearest to it
}

TEST(Cases, SilentBeyondCriticalIncidence) {
  const World w{.walls = {{{2, -50}, {2, 50}, {30 * kDegree}}}};
  expect(w, cone(0, 0, 0, 20), EchoStatus::ok, 2);
  expect(w, cone(0, 0, 39, 20), EchoStatus::ok, 2 / std::cos(29 * kDegree));
  expect(w, cone(0, 0, 41, 20), EchoStatus::none, 0);
  expect(w, cone(0, 0, 40, 20), EchoStatus::ok, 2 / std::cos(30 * kDegree));  // closed
}

TEST(Cases, SilentSurfaceHides) {
  // A shiny plate at 45° before a wall: all of the wall is behind it.
  World w{.walls = {{{3, -5}, {3, 5}, {}}, {{1, -1}, {3, 1}, kShiny}}};
  expect(w, cone(0, 0, 0, 15), EchoStatus::none, 0);
  // A plate that covers the lower half of the cone only: the wall is seen from its end on.
  w.walls[1] = {{1, -1}, {1.5, 0.05}, kShiny};
  expect(w, cone(0, 0, 0, 15), EchoStatus::ok, 3 * std::hypot(1, 0.05 / 1.5));
  // A pole behind the plate is hidden, one before it is not.
  w = {.walls = {{{1, -1}, {3, 1}, kShiny}}, .circles = {{{2.5, 0}, 0.01, {}}}};
  expect(w, cone(0, 0, 0, 15), EchoStatus::none, 0);
  w.circles[0].centre = {1.5, 0};
  expect(w, cone(0, 0, 0, 15), EchoStatus::ok, 1.49);
}

TEST(Cases, PartlyHiddenByACrossingWall) {
  // The wall x = 2 is cut at (2, 0) by a shiny one that is in front of it for y < 0 only.
  const World w{.walls = {{{2, -5}, {2, 5}, {}}, {{1, -2}, {3, 2}, kShiny}}};
  expect(w, cone(0, 0, 0, 20), EchoStatus::ok, 2);
  expect(w, cone(0, 0, -8, 10), EchoStatus::none, 0);
  expect(w, cone(0, 0, 10, 10), EchoStatus::ok, 2 / std::cos(5 * kDegree));
}

TEST(Cases, ThinPoleIsNeverMissed) {
  for (double radius : {0.0, 1e-6, 1e-4, 0.01})
    for (double off_deg = -7.5; off_deg <= 7.5; off_deg += 0.1) {
      const double a = off_deg * kDegree;
      const World w{.walls = {{{4, -5}, {4, 5}, {}}},
                    .circles = {{{3 * std::cos(a), 3 * std::sin(a)}, radius, kShiny}}};
      expect(w, cone(0, 0, 0, 15.0001), EchoStatus::ok, 3 - radius);
    }
}

TEST(Cases, PoleAtTheEdgeOfTheCone) {
  // The centre is outside; the nearest point in the cone lies on its edge, at incidence asin(D sin(θ) / r).
  const double off = 2 * kDegree, r = 0.2, centre = 2;
  World w{.circles = {{{centre * std::cos(9.5 * kDegree), centre * std::sin(9.5 * kDegree)}, r, {}}}};
  const double q = centre * std::sin(off);
  expect(w, cone(0, 0, 0, 15), EchoStatus::ok, centre * std::cos(off) - std::sqrt(r * r - q * q));
  const double incidence = std::asin(q / r);
  w.circles[0].material = {incidence + 1e-6};
  expect(w, cone(0, 0, 0, 15), EchoStatus::ok, centre * std::cos(off) - std::sqrt(r * r - q * q));
  w.circles[0].material = {incidence - 1e-6};
  expect(w, cone(0, 0, 0, 15), EchoStatus::none, 0);
}

TEST(Cases, TooCloseOnlyWhenItEchoes) {
  World w{.walls = {{{2, -5}, {2, 5}, {}}}, .circles = {{{0.15, 0}, 0.1, {}}}};
  expect(w, cone(0, 0, 0, 15, 0.1), EchoStatus::too_close, 0.05);
  // A silent one so near says nothing, and hides the wall: edge of the cone up to its tangent.
  w = {.walls = {{{2, -5}, {2, 5}, {}}, {{0.05, -0.1}, {0.1, 0.1}, {1 * kDegree}}}};
  expect(w, cone(0, 0, 0, 15, 0.1), EchoStatus::none, 0);
}

TEST(Cases, SensorOnASurface) {
  const World w{.walls = {{{0, -1}, {0, 1}, kShiny}, {{2, -5}, {2, 5}, {}}}};
  for (double yaw : {0.0, 45.0, 90.0, 180.0}) {
    expect(w, cone(0, 0, yaw), EchoStatus::too_close, 0);
    expect(w, cone(0, 1, yaw), EchoStatus::too_close, 0);
    expect(w, cone(0, 0, yaw, 15, 0), EchoStatus::ok, 0);
  }
  const World pole{.circles = {{{1, 0}, 1, {}}}};
  expect(pole, cone(0, 0, 0), EchoStatus::too_close, 0);
}

TEST(Cases, Degenerate) {
  const World post{.walls = {{{2, 0}, {2, 0}, kShiny}}};  // a wall without length echoes
  expect(post, cone(0, 0, 0), EchoStatus::ok, 2);
  expect(post, cone(0, 0, 0, 0), EchoStatus::ok, 2);
  expect(post, cone(0, 0, 90), EchoStatus::none, 0);
  expect({.boxes = {{{2, 0}, 0, 0, 1, {}}}}, cone(0, 0, 0), EchoStatus::ok, 2);
  expect({.boxes = {{{2, 0}, 2, 0, 0, {}}}}, cone(0, 0, 0), EchoStatus::ok, 1);
  const World mirror{.walls = {{{2, -1}, {2, 1}, {0}}}};  // echoes at exactly 0°
  expect(mirror, cone(0, 0, 0), EchoStatus::ok, 2);
  expect(mirror, cone(0, 0.3, 0), EchoStatus::ok, 2);
  expect(mirror, cone(0, 0, 10), EchoStatus::none, 0);
}

TEST(Cases, SingleRayCone) {
  const World w{.walls = {{{2, -1}, {2, 1}, {40 * kDegree}}}};
  expect(w, cone(0, 0, 20, 0), EchoStatus::ok, 2 / std::cos(20 * kDegree));
  expect(w, cone(0, 0, 30, 0), EchoStatus::none, 0);
}

TEST(Cases, BadWorldsAndQueriesAreRefusedByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message([&] { BothIndices({.walls = {{{0, 0}, {0, nan}, {}}}}); }), "wall 0: a coordinate is not finite");
  EXPECT_EQ(message([&] {
              BothIndices({.circles = {{{0, 0}, 1, {}}, {{0, 0}, -1, {}}}});
            }),
            "circle 1: radius_m is negative");
  EXPECT_EQ(message([&] {
              BothIndices({.boxes = {{{0, 0}, -1, 1, 0, {}}}});
            }),
            "box 0: length_m or width_m is negative");
  EXPECT_EQ(message([&] { BothIndices({.polygons = {{{{0, 0}}, {}}}}); }), "polygon 0: has fewer than two vertices");
  EXPECT_EQ(message([&] {
              BothIndices({.walls = {{{0, 0}, {1, 0}, {2}}}});
            }),
            "wall 0: critical_incidence_rad is outside [0, pi/2]");
  const BothIndices scene(World{});
  EXPECT_NE(message([&] { (void)scene.cast_cone(cone(nan, 0, 0)); }), "accepted");
  EXPECT_NE(message([&] { (void)scene.cast_cone(cone(0, 0, 0, 200)); }), "accepted");
  EXPECT_NE(message([&] { (void)scene.cast_cone(cone(0, 0, 0, 15, 3, 2)); }), "accepted");
  EXPECT_NE(message([&] { (void)scene.ray_range(0, 0, nan, 1); }), "accepted");
}

TEST(Cases, FloatingPointModesOfTheCallerAreKept) {
  const World w{.walls = {{{2, -5}, {2, 5}, kShiny}}};
  const unsigned before = 0x1f80;  // the default: nothing flushed, rounding to nearest, no traps
  _mm_setcsr(before);
  const BothIndices scene(w);
  (void)scene.cast_cone(cone(0, 0, 40));
  (void)scene.ray_range(0, 0, 0, 5);
  EXPECT_EQ(_mm_getcsr() & ~0x3fu, before);  // but for the sticky exception flags
}

}  // namespace
}  // namespace evigrid::raycast
