// SPDX-License-Identifier: Apache-2.0
// Exactly aligned scenes, which random ones never hit: walls along the axes and on the edges of the cone, joints of
// walls, ends on ends, sensors at round coordinates, headings at every multiple of half the opening.
#include <gtest/gtest.h>

#include "both_indices.hpp"
#include "evigrid/raycast/reference.hpp"
#include "evigrid/raycast/scene.hpp"
#include "random_world.hpp"

namespace evigrid::raycast {
namespace {

using testing::BothIndices;

using testing::kDegree;
using testing::Random;

TEST(Aligned, GridScenesEqualReference) {
  // Everything on a lattice of half a metre, critical incidences of 0, 15, 30, 45 and 90 degrees.
  Random r(7);
  const auto lattice = [&](int n) { return 0.5 * r.below(2 * n + 1); };
  const auto material = [&] {
    const double choice[5] = {0, 15, 30, 45, 90};
    return Material{choice[r.below(5)] * kDegree};
  };
  int different = 0, cones = 0;
  for (int k = 0; k < 60; ++k) {
    World w;
    w.polygons.push_back({{{0, 0}, {6, 0}, {6, 4}, {0, 4}}, material()});
    for (int i = 0; i < 3; ++i)
      w.boxes.push_back({{lattice(6), lattice(4)}, 0.5 + lattice(1), 0.5 + lattice(1), 0, material()});
    for (int i = 0; i < 5; ++i) {
      const Point from{lattice(6), lattice(4)};
      const Point to = r.below(2) ? Point{lattice(6), from.y_m} : Point{lattice(6), lattice(4)};
      w.walls.push_back({from, to, material()});
    }
    for (int i = 0; i < 3; ++i) w.circles.push_back({{lattice(6), lattice(4)}, 0.23 * (1 + r.below(2)), material()});
    const BothIndices scene(w);
    for (int c = 0; c < 100; ++c, ++cones) {
      const double aperture_deg = 15.0 * (1 + r.below(4));
      const ConeQuery q{lattice(6), lattice(4), r.below(48) * 7.5 * kDegree, aperture_deg * kDegree, 0.2, 5};
      const Echo expected = reference_cone(w, q), got = scene.cast_cone(q);
      const bool same = got.status == expected.status &&
                        (got.status == EchoStatus::none || std::abs(got.range_m - expected.range_m) < 1e-5);
      EXPECT_TRUE(same) << "world " << k << " cone " << c << " at " << q.x_m << ", " << q.y_m << " yaw "
                        << q.yaw_rad / kDegree << " aperture " << aperture_deg << ": " << got.range_m << " instead of "
                        << expected.range_m;
      different += !same;
    }
  }
  EXPECT_EQ(different, 0) << "of " << cones;
}

TEST(Aligned, WallOnTheEdgeOfTheConeBelongsToIt) {
  // The wall lies exactly on the edge at 0°, 90°, ...: seen edge-on, from its nearer end, at incidence 90°.
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double a = quarter * 90 * kDegree, dx = std::round(std::cos(a)), dy = std::round(std::sin(a));
    for (double side : {-1.0, 1.0}) {
      const ConeQuery q{0, 0, a + side * 7.5 * kDegree, 15 * kDegree, 0.1, 5};
      World w{.walls = {{{dx, dy}, {2 * dx, 2 * dy}, {}}}};
      EXPECT_NEAR(BothIndices(w).cast_cone(q).range_m, 1, 1e-9) << quarter << side;
      EXPECT_NEAR(reference_cone(w, q).range_m, 1, 1e-9) << quarter << side;
      w.walls[0].material = {80 * kDegree};
      EXPECT_EQ(BothIndices(w).cast_cone(q).status, EchoStatus::none) << quarter << side;
      EXPECT_EQ(reference_cone(w, q).status, EchoStatus::none) << quarter << side;
    }
  }
}

TEST(Aligned, CircleTangentToTheEdgeOfTheCone) {
  // At a tangent the range changes with the square root of the angle: 1e-12 rad of slack is a micrometre there.
  for (double heading_deg = 0; heading_deg < 360; heading_deg += 7.5) {
    const double towards = (heading_deg + 37.5) * kDegree, edge_to_centre = 30 * kDegree;
    const World w{.circles = {{{2 * std::cos(towards), 2 * std::sin(towards)}, 2 * std::sin(edge_to_centre), {}}}};
    const ConeQuery q{0, 0, heading_deg * kDegree, 15 * kDegree, 0.1, 5};
    EXPECT_NEAR(BothIndices(w).cast_cone(q).range_m, 2 * std::cos(edge_to_centre), 1e-5) << heading_deg;
    EXPECT_NEAR(reference_cone(w, q).range_m, 2 * std::cos(edge_to_centre), 1e-5) << heading_deg;
  }
}

TEST(Aligned, NoEchoThroughTheJointOfTwoShinyWalls) {
  // Two plates meet on the axis; behind the joint stands a wall. Also where a plate ends exactly at the edge.
  const Material shiny{5 * kDegree};
  for (double heading_deg = 0; heading_deg < 360; heading_deg += 7.5) {
    const double c = std::cos(heading_deg * kDegree), s = std::sin(heading_deg * kDegree);
    const auto turned = [&](double x, double y) { return Point{c * x - s * y, s * x + c * y}; };
    const double edge = std::tan(7.5 * kDegree);
    const World w{.walls = {{turned(1, 0), turned(2, 2 * edge), shiny},
                            {turned(1, 0), turned(2, -2 * edge), shiny},
                            {turned(3, -5), turned(3, 5), {}}}};
    const ConeQuery q{0, 0, heading_deg * kDegree, 15 * kDegree, 0.1, 5};
    EXPECT_EQ(BothIndices(w).cast_cone(q).status, EchoStatus::none) << heading_deg;
    EXPECT_EQ(reference_cone(w, q).status, EchoStatus::none) << heading_deg;
  }
}

TEST(Aligned, WallTouchingFromBehindStaysHidden) {
  // An echoing wall ends on the back of a shiny one.
  const World w{.walls = {{{2, -5}, {2, 5}, {5 * kDegree}}, {{2, 1}, {3, 1.7}, {}}}};
  const ConeQuery q{0, 0, std::atan2(1, 2), 15 * kDegree, 0.1, 5};
  EXPECT_EQ(BothIndices(w).cast_cone(q).status, EchoStatus::none);
  EXPECT_EQ(reference_cone(w, q).status, EchoStatus::none);
}

TEST(Aligned, SurfacesLyingOnOneAnotherAreBothSeen) {
  const World w{.walls = {{{2, -5}, {2, 5}, {5 * kDegree}}, {{2, 0.5}, {2, 1.5}, {}}}};
  const ConeQuery q{0, 0, std::atan2(1, 2), 15 * kDegree, 0.1, 5};
  const double nearest = 2 / std::cos(std::atan2(1, 2) - 7.5 * kDegree);
  EXPECT_NEAR(BothIndices(w).cast_cone(q).range_m, nearest, 1e-9);
  EXPECT_NEAR(reference_cone(w, q).range_m, nearest, 1e-9);
}

}  // namespace
}  // namespace evigrid::raycast
