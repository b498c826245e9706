// SPDX-License-Identifier: Apache-2.0
// Tours: every leg measured against every surface point by point, coverage by a search of the test's own, refusals.
#include "evigrid/scenes/tour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include "evigrid/scenes/building.hpp"
#include "evigrid/scenes/truth.hpp"
#include "scenes/src/tour/distance.hpp"

namespace evigrid::scenes {
namespace {

using raycast::Point;
using raycast::World;

double to_segment(Point p, Point a, Point b) {
  const double length = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
  if (length == 0) return std::hypot(p.x_m - a.x_m, p.y_m - a.y_m);
  const double ux = (b.x_m - a.x_m) / length, uy = (b.y_m - a.y_m) / length;
  const double along = std::clamp((p.x_m - a.x_m) * ux + (p.y_m - a.y_m) * uy, 0.0, length);
  return std::hypot(p.x_m - a.x_m - along * ux, p.y_m - a.y_m - along * uy);
}

double clearance(const World& world, Point p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& w : world.walls) least = std::min(least, to_segment(p, w.from, w.to));
  for (const auto& box : world.boxes) {  // in the frame of the box
    const double c = std::cos(box.yaw_rad), s = std::sin(box.yaw_rad);
    const double dx = p.x_m - box.centre.x_m, dy = p.y_m - box.centre.y_m;
    const Point q{c * dx + s * dy, c * dy - s * dx};
    const double l = box.length_m / 2, w = box.width_m / 2;
    for (const double side : {-1.0, 1.0}) {
      least = std::min(least, to_segment(q, {-l, side * w}, {l, side * w}));
      least = std::min(least, to_segment(q, {side * l, -w}, {side * l, w}));
    }
  }
  for (const auto& circle : world.circles)
    least =
        std::min(least, std::abs(std::hypot(p.x_m - circle.centre.x_m, p.y_m - circle.centre.y_m) - circle.radius_m));
  for (const auto& polygon : world.polygons)
    for (std::size_t k = 0; k < polygon.vertices.size(); ++k)
      least = std::min(least, to_segment(p, polygon.vertices[k], polygon.vertices[(k + 1) % polygon.vertices.size()]));
  return least;
}

double least_clearance(const World& world, const std::vector<Point>& tour) {
  double least = clearance(world, tour.front());
  for (std::size_t i = 1; i < tour.size(); ++i) {
    const Point a = tour[i - 1], b = tour[i];
    const int n = 1 + static_cast<int>(std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) / 0.02);
    for (int k = 0; k <= n; ++k)
      least = std::min(least, clearance(world, {a.x_m + (b.x_m - a.x_m) * k / n, a.y_m + (b.y_m - a.y_m) * k / n}));
  }
  return least;
}

double distance_to(const std::vector<Point>& tour, Point p) {
  double least = std::hypot(p.x_m - tour[0].x_m, p.y_m - tour[0].y_m);
  for (std::size_t i = 1; i < tour.size(); ++i) least = std::min(least, to_segment(p, tour[i - 1], tour[i]));
  return least;
}

/// Points on a 0.1 m lattice that keep the clearance (and a little) and are joined with the start through such points.
std::vector<Point> places(const World& world, Point start, double clearance_m) {
  const Extent e = extent(world);
  const double step = 0.1;
  const int w = static_cast<int>((e.high.x_m - e.low.x_m) / step),
            h = static_cast<int>((e.high.y_m - e.low.y_m) / step);
  const auto at = [&](int i) { return Point{e.low.x_m + step * (i % w), e.low.y_m + step * (i / w)}; };
  std::vector<std::uint8_t> state(static_cast<std::size_t>(w * h), 0);  // 1: can stand, 2: reached
  for (int i = 0; i < w * h; ++i) state[static_cast<std::size_t>(i)] = clearance(world, at(i)) >= clearance_m + 0.03;
  std::vector<int> open{static_cast<int>(std::lround((start.y_m - e.low.y_m) / step)) * w +
                        static_cast<int>(std::lround((start.x_m - e.low.x_m) / step))};
  std::vector<Point> found;
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    if (i < 0 || i >= w * h || state[static_cast<std::size_t>(i)] != 1) continue;
    state[static_cast<std::size_t>(i)] = 2;
    found.push_back(at(i));
    for (const int next : {i + 1, i - 1, i + w, i - w}) open.push_back(next);
  }
  return found;
}

World room_with_a_chamber() {
  World world;
  world.polygons.push_back({{{0, 0}, {8, 0}, {8, 6}, {0, 6}}, {}});
  world.boxes.push_back({{6.5, 4.5}, 2, 2, 0.3, {}});  // a closed chamber of 2 × 2 m: nobody gets in
  world.circles.push_back({{2, 3}, 0.5, {}});
  return world;
}

TEST(Tour, KeepsTheClearanceAndComesNearEveryPlace) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    BuildingSpec building;
    building.width_m = 22;
    building.depth_m = 16;
    building.seed = seed;
    const World world = make_building(building);
    TourSpec spec;
    spec.clearance_m = seed % 2 == 0 ? 0.3 : 0.22;
    spec.spacing_m = seed % 3 == 0 ? 1.5 : 2.5;
    spec.start = find_start(world, spec.clearance_m);
    const std::vector<Point> tour = make_tour(world, spec);
    ASSERT_GT(tour.size(), 10u);
    EXPECT_EQ(tour[0].x_m, spec.start.x_m);
    EXPECT_EQ(tour[0].y_m, spec.start.y_m);
    EXPECT_GE(least_clearance(world, tour), spec.clearance_m - 0.3 * spec.cell_m) << "seed " << seed;
    const std::vector<Point> all = places(world, spec.start, spec.clearance_m);
    EXPECT_GT(all.size(), 10'000u);
    double farthest = 0;
    for (const Point& p : all) farthest = std::max(farthest, distance_to(tour, p));
    EXPECT_LE(farthest, spec.spacing_m + 3 * spec.cell_m) << "seed " << seed;
    for (std::size_t i = 1; i < tour.size(); ++i)
      EXPECT_GT(std::hypot(tour[i].x_m - tour[i - 1].x_m, tour[i].y_m - tour[i - 1].y_m), 0.0);
    const std::vector<Point> again = make_tour(world, spec);
    ASSERT_EQ(again.size(), tour.size());
    for (std::size_t i = 0; i < tour.size(); ++i) {
      EXPECT_EQ(again[i].x_m, tour[i].x_m);
      EXPECT_EQ(again[i].y_m, tour[i].y_m);
    }
  }
}

TEST(Tour, LeavesOutWhatCannotBeReached) {
  const World world = room_with_a_chamber();
  const std::vector<Point> tour = make_tour(world, {.start = {1, 1}, .spacing_m = 1});
  EXPECT_GT(tour.size(), 5u);
  for (const Point& p : tour) EXPECT_GT(std::max(std::abs(p.x_m - 6.5), std::abs(p.y_m - 4.5)), 0.9);
  // From within the chamber it is the only place.
  for (const Point& p : make_tour(world, {.start = {6.5, 4.5}, .spacing_m = 0.5}))
    EXPECT_LT(std::max(std::abs(p.x_m - 6.5), std::abs(p.y_m - 4.5)), 1.0);
}

TEST(Tour, NoThinWallIsCrossedWithAClearanceBelowTheCell) {
  World world;
  world.polygons.push_back({{{0, 0}, {4, 0}, {4, 3}, {0, 3}}, {}});
  world.walls.push_back({{2, 0}, {2, 3}, {}});
  const std::vector<Point> tour =
      make_tour(world, {.start = {1, 1}, .clearance_m = 0.03, .spacing_m = 0.8, .cell_m = 0.1});
  EXPECT_GE(least_clearance(world, tour), 0.02);
  for (const Point& p : tour) EXPECT_LT(p.x_m, 2);
}

TEST(Tour, ANarrowDoorIsPassedWhenTheRobotFits) {
  World world;  // two rooms, a gap of 0.64 m
  world.polygons.push_back({{{0, 0}, {6, 0}, {6, 3}, {0, 3}}, {}});
  world.walls.push_back({{3, 0}, {3, 1.18}, {}});
  world.walls.push_back({{3, 1.82}, {3, 3}, {}});
  const auto reaches = [&](double clearance_m) {
    const auto tour = make_tour(world, {.start = {1, 1}, .clearance_m = clearance_m, .spacing_m = 1, .cell_m = 0.05});
    return std::any_of(tour.begin(), tour.end(), [](Point p) { return p.x_m > 4; });
  };
  EXPECT_TRUE(reaches(0.29));
  EXPECT_FALSE(reaches(0.325));
}

template <class Call>
std::string refusal(Call call) {
  try {
    (void)call();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "none";
}

TEST(Tour, AStartTooNearIsRefusedAndTheNearestGoodPlaceNamed) {
  const World world = room_with_a_chamber();
  const std::string message = refusal([&] { return make_tour(world, {.start = {0.1, 3}}); });
  double x = 0, y = 0;
  const std::size_t at = message.find("the nearest place that is not is (");
  ASSERT_NE(at, std::string::npos) << message;
  ASSERT_EQ(std::sscanf(message.c_str() + at, "the nearest place that is not is (%lf, %lf)", &x, &y), 2) << message;
  EXPECT_GE(clearance(world, {x, y}), 0.3);
  EXPECT_LT(std::hypot(x - 0.1, y - 3), 0.4);
  EXPECT_NE(message.find("0.100000 m from a surface"), std::string::npos) << message;
  const std::string crowded = refusal([&] { return make_tour(world, {.start = {1, 1}, .clearance_m = 5}); });
  EXPECT_NE(crowded.find("no place in this world"), std::string::npos) << crowded;
  EXPECT_NE(refusal([&] { return make_tour(world, {.start = {NAN, 1}}); }).find("start"), std::string::npos);
  EXPECT_NE(refusal([&] {
              return make_tour(world, {.start = {1, 1}, .spacing_m = 0});
            }).find("spacing_m"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              return make_tour(world, {.start = {1, 1}, .clearance_m = 0});
            }).find("clearance_m"),
            std::string::npos);
  EXPECT_NE(refusal([&] { return find_start(world, 5); }).find("no place"), std::string::npos);
}

TEST(Tour, FindsAStartInTheRoomAndNotOutside) {
  World world;  // an L whose notch, outside, is wider than its arms
  world.polygons.push_back({{{0, 0}, {20, 0}, {20, 2}, {2, 2}, {2, 20}, {0, 20}}, {}});
  const Point p = find_start(world, 0.3);
  EXPECT_GT(std::min(p.x_m, p.y_m), 0);
  EXPECT_LT(std::min(p.x_m, p.y_m), 2);
  EXPECT_GT(clearance(world, p), 0.9);
  const World room = room_with_a_chamber();
  const Point middle = find_start(room, 0.3);
  EXPECT_GT(clearance(room, middle), 1.5);
}

TEST(Tour, AnOpenWorldHasToursToo) {
  World world;
  world.circles.push_back({{0, 0}, 1, {}});
  world.circles.push_back({{6, 6}, 1, {}});
  const std::vector<Point> tour = make_tour(world, {.start = {3, 3}});
  EXPECT_GT(tour.size(), 4u);
  EXPECT_GE(least_clearance(world, tour), 0.27);
  EXPECT_EQ(make_tour({}, {.start = {3, 3}}).front().x_m, 3);
}

TEST(Tour, RingsOfAllSizesAreKeptAwayFrom) {
  std::mt19937_64 random(11);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (int round = 0; round < 8; ++round) {
    World world;
    world.circles.push_back({{uniform(-1, 1), uniform(-1, 1)}, 12, {}});  // all lies within it
    for (int i = 0; i < 6; ++i) world.circles.push_back({{uniform(-8, 8), uniform(-8, 8)}, uniform(0.01, 5), {}});
    const Point start = find_start(world, 0.3);
    EXPECT_GE(least_clearance(world, make_tour(world, {.start = start})), 0.27) << round;
  }
}

TEST(Tour, TheSearchGridIsBounded) {
  const World world = room_with_a_chamber();
  EXPECT_THROW((void)make_tour(world, {.start = {1, 1}, .most_cells = 4000}), std::length_error);
  EXPECT_THROW((void)find_start(world, 0.3, 0.1, 4000), std::length_error);
  EXPECT_NO_THROW((void)find_start(world, 0.3, 0.1, 8000));
}

TEST(DistanceTransform, IsExact) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 60; ++round) {
    TruthGrid grid;
    grid.width = 1 + static_cast<std::int64_t>(random() % 40);
    grid.height = 1 + static_cast<std::int64_t>(random() % 40);
    grid.cells.resize(static_cast<std::size_t>(grid.width * grid.height));
    const std::uint64_t rare = 1 + random() % 200;
    for (TruthCell& c : grid.cells) c = random() % rare == 0 ? TruthCell::surface : TruthCell::free;
    const std::vector<std::uint32_t> fast = squared_distance(grid);
    for (std::int64_t i = 0; i < std::ssize(grid.cells); ++i) {
      std::uint32_t least = kFarAway;
      for (std::int64_t j = 0; j < std::ssize(grid.cells); ++j) {
        const std::int64_t dx = i % grid.width - j % grid.width, dy = i / grid.width - j / grid.width;
        if (grid.cells[static_cast<std::size_t>(j)] == TruthCell::surface)
          least = std::min(least, static_cast<std::uint32_t>(dx * dx + dy * dy));
      }
      ASSERT_EQ(fast[static_cast<std::size_t>(i)], least) << round << " cell " << i;
    }
  }
}

}  // namespace
}  // namespace evigrid::scenes
