// SPDX-License-Identifier: Apache-2.0
// Ways judged by the true room: clearances against distances known by hand.
#include "paper/routes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace evigrid::driver {
namespace {

/// 3 × 2 m with a box of 0.4 × 0.4 m around (2, 1), shifted so that the map's first cell is not (0, 0).
raycast::World room() {
  raycast::World w;
  w.polygons.push_back({{{-1, 2}, {2, 2}, {2, 4}, {-1, 4}}, {}});
  w.boxes.push_back({{1, 3}, 0.4, 0.4, 0, {}});
  return w;
}
constexpr CellRect kRect{-10, 20, 30, 20};

double by_hand(double x, double y) {  // of a point in free space, in the room's frame
  const double wall = std::min({x, 3 - x, y, 2 - y});
  return std::min(wall, std::hypot(std::max(std::abs(x - 2) - 0.2, 0.0), std::max(std::abs(y - 1) - 0.2, 0.0)));
}

TEST(Clearance, IsTheDistanceFromTheNearestTrueSurface) {
  const Clearance clearance(room(), kRect, 0.1, {0, 3});
  ASSERT_LE(clearance.raster_m(), 0.02);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 30; ++x) {
      const double cx = 0.1 * x + 0.05, cy = 0.1 * y + 0.05;
      const bool solid = std::abs(cx - 2) < 0.2 && std::abs(cy - 1) < 0.2;
      ASSERT_NEAR(clearance.at({x, y}), solid ? 0 : by_hand(cx, cy), 1.5 * clearance.raster_m()) << x << ", " << y;
    }
}

TEST(Clearance, JudgesAWay) {
  const Clearance clearance(room(), kRect, 0.1, {0, 3});
  Planner planner;
  CostGrid grid(30, 20);  // the box is not in the map: the way leads straight through it
  const Way way = clearance.judge(planner, grid, {"P", {5, 10}, {25, 10}}, 0.2);
  ASSERT_TRUE(way.found);
  EXPECT_NEAR(way.length_m, 2, 1e-9);
  EXPECT_EQ(way.least_m, 0);
  EXPECT_EQ(way.in_obstacle, 4u);  // centres 1.85, 1.95, 2.05, 2.15
  EXPECT_EQ(way.too_near, 8u);     // and two on either side, 0.05 and 0.15 m off
  grid.cost.assign(grid.cost.size(), kBlocked);
  EXPECT_FALSE(clearance.judge(planner, grid, {"P", {5, 10}, {25, 10}}, 0.2).found);
}

TEST(Routes, StepsCostByPlausibilityAndStopAboveTheThreshold) {
  Layers l;
  l.rect = {0, 0, 4, 1};
  l.cell_m = 0.1;
  l.planes = {0.9F, 0.5F, 0.1F, 0, 0, 0.5F, 0.2F, 0, 0.1F, 0, 0.7F, 1, 0, 0, 0, 0};  // e, o, u, conflict of four cells
  const std::vector<float> m = occupancy(l);
  EXPECT_FLOAT_EQ(m[0], 0.1F);
  EXPECT_FLOAT_EQ(m[1], 0.5F);
  EXPECT_FLOAT_EQ(m[2], 0.9F);
  EXPECT_FLOAT_EQ(m[3], 1);  // unknown is as dear as occupied
  const CostGrid grid = cost_grid(l, m, {.weight = 10, .blocked_above = 0.8});
  EXPECT_FLOAT_EQ(grid.cost[0], 2);
  EXPECT_FLOAT_EQ(grid.cost[1], 6);
  EXPECT_EQ(grid.cost[2], kBlocked);
  EXPECT_EQ(grid.cost[3], kBlocked);
}

}  // namespace
}  // namespace evigrid::driver
