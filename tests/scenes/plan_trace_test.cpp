// SPDX-License-Identifier: Apache-2.0
// Outlines of hand-made and of random bitmaps against what can be counted on the pixels: the winding number of every
// pixel's centre is 1 on a wall and 0 elsewhere, and the outlines are as long as there are pixel edges between the two.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "plan_files.hpp"

namespace evigrid::scenes {
namespace {

using raycast::Point;
using raycast::Polygon;
using std::string;

const TraceOptions kExact{.simplify_px = 0};

/// Sum over polygons of the turns around p, by crossings of the ray to the east.
int winding(const std::vector<Polygon>& polygons, Point p) {
  int turns = 0;
  for (const Polygon& polygon : polygons)
    for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
      const Point &a = polygon.vertices[i], &b = polygon.vertices[(i + 1) % polygon.vertices.size()];
      if ((a.y_m <= p.y_m) == (b.y_m <= p.y_m)) continue;
      const double x = a.x_m + (p.y_m - a.y_m) / (b.y_m - a.y_m) * (b.x_m - a.x_m);
      if (x > p.x_m) turns += b.y_m > a.y_m ? 1 : -1;
    }
  return turns;
}

double length(const std::vector<Polygon>& polygons) {
  double sum = 0;
  for (const Polygon& polygon : polygons)
    for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
      const Point &a = polygon.vertices[i], &b = polygon.vertices[(i + 1) % polygon.vertices.size()];
      sum += std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    }
  return sum;
}

bool wall(const FloorPlan& plan, std::int64_t x, std::int64_t y) {
  return x >= 0 && y >= 0 && x < plan.width && y < plan.height && plan.at(x, y) == PlanCell::occupied;
}

std::int64_t pixel_edges(const FloorPlan& plan) {
  std::int64_t edges = 0;
  for (std::int64_t y = 0; y <= plan.height; ++y)
    for (std::int64_t x = 0; x <= plan.width; ++x)
      edges += (wall(plan, x, y) != wall(plan, x - 1, y)) + (wall(plan, x, y) != wall(plan, x, y - 1));
  return edges;
}

string text_of(const std::vector<Polygon>& polygons) {
  std::ostringstream out;
  for (const Polygon& p : polygons) {
    for (const Point& v : p.vertices) out << v.x_m << ',' << v.y_m << ' ';
    out << '\n';
  }
  return out.str();
}

TEST(Trace, HandMade) {
  EXPECT_EQ(text_of(trace(plan_of("...\n.#.\n...\n"), kExact)), "2,1 2,2 1,2 1,1 \n");
  EXPECT_EQ(text_of(trace(plan_of("###\n###\n"), kExact)), "3,0 3,2 0,2 0,0 \n");  // up to the image's edge
  // A room: outside counter-clockwise, inside clockwise.
  EXPECT_EQ(text_of(trace(plan_of("###\n#.#\n###\n"), kExact)), "3,0 3,3 0,3 0,0 \n2,2 2,1 1,1 1,2 \n");
  EXPECT_EQ(text_of(trace(plan_of("#.\n##\n"), kExact)), "2,0 2,1 1,1 1,2 0,2 0,0 \n");
  // Two walls that touch at a corner are one, and pass that corner twice.
  EXPECT_EQ(text_of(trace(plan_of(".#\n#.\n"), kExact)), "1,0 1,1 2,1 2,2 1,2 1,1 0,1 0,0 \n");
  EXPECT_EQ(text_of(trace(plan_of("#.\n.#\n"), kExact)), "2,0 2,1 1,1 1,2 0,2 0,1 1,1 1,0 \n");
  // Two free pixels that touch at a corner are two rooms.
  EXPECT_EQ(trace(plan_of("####\n#.##\n##.#\n####\n"), kExact).size(), 3u);
  EXPECT_TRUE(trace(plan_of("..\n..\n"), kExact).empty());
  EXPECT_TRUE(trace(FloorPlan{.width = 0, .height = 0, .resolution_m = 1, .resolution_y_m = 1}, kExact).empty());
}

TEST(Trace, Options) {
  const FloorPlan plan = plan_of("?.\n#.\n");
  EXPECT_EQ(text_of(trace(plan, kExact)), "1,0 1,1 0,1 0,0 \n");
  EXPECT_EQ(text_of(trace(plan, {.simplify_px = 0, .unknown_is_wall = true})), "1,0 1,2 0,2 0,0 \n");
  EXPECT_EQ(text_of(trace(plan, {.simplify_px = 0, .border_is_wall = true})), "1,0 1,1 0,1 0,0 \n0,0 2,0 2,2 0,2 \n");
  const raycast::Material glass{.critical_incidence_rad = 0.3, .absorption = 0.2};
  for (const Polygon& p : trace(plan, {.border_is_wall = true, .material = glass})) {
    EXPECT_EQ(p.material.critical_incidence_rad, 0.3);
    EXPECT_EQ(p.material.absorption, 0.2);
  }
}

TEST(Trace, ScaleTurnAndShift) {
  FloorPlan plan = plan_of("..\n.#\n");
  plan.resolution_m = 0.5;
  plan.resolution_y_m = 0.25;
  plan.origin = {10, 20, 3.14159265358979323846 / 2};  // x becomes y, y becomes −x
  const std::vector<Polygon> polygons = trace(plan, kExact);
  ASSERT_EQ(polygons.size(), 1u);
  const double expected[4][2] = {{10, 21}, {9.75, 21}, {9.75, 20.5}, {10, 20.5}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(polygons[0].vertices[i].x_m, expected[i][0], 1e-12);
    EXPECT_NEAR(polygons[0].vertices[i].y_m, expected[i][1], 1e-12);
  }
}

TEST(Trace, BadArguments) {
  FloorPlan plan = plan_of("#\n");
  EXPECT_THROW((void)trace(plan, {.simplify_px = -1}), std::invalid_argument);
  EXPECT_THROW((void)trace(plan, {.simplify_px = NAN}), std::invalid_argument);
  plan.width = 2;
  EXPECT_THROW((void)trace(plan), std::invalid_argument);
  plan.width = 1;
  plan.resolution_m = 0;
  EXPECT_THROW((void)trace(plan), std::invalid_argument);
}

TEST(Trace, NoiseIsRefusedBeforeItFillsTheMemory) {
  FloorPlan plan;
  plan.resolution_m = plan.resolution_y_m = 1;
  plan.width = plan.height = 6400;  // isolated pixels: 10.2 million rings of four corners
  plan.cells.resize(static_cast<std::size_t>(plan.width * plan.height));
  for (std::int64_t y = 0; y < plan.height; y += 2)
    for (std::int64_t x = 0; x < plan.width; x += 2)
      plan.cells[static_cast<std::size_t>(y * plan.width + x)] = PlanCell::occupied;
  EXPECT_THROW((void)trace(plan), std::length_error);
}

TEST(Trace, RandomBitmaps) {
  std::mt19937 random(1);
  std::size_t joints = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    FloorPlan plan;
    plan.resolution_m = plan.resolution_y_m = 1;
    plan.width = 1 + static_cast<int>(random() % 14);
    plan.height = 1 + static_cast<int>(random() % 14);
    const unsigned density = 1 + random() % 9;
    for (std::int64_t i = 0; i < plan.width * plan.height; ++i)
      plan.cells.push_back(random() % 10 < density ? PlanCell::occupied : PlanCell::free);
    const std::vector<Polygon> polygons = trace(plan, kExact);
    for (std::int64_t y = 0; y < plan.height; ++y)
      for (std::int64_t x = 0; x < plan.width; ++x)
        ASSERT_EQ(winding(polygons, {static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5}), wall(plan, x, y))
            << rows_of(plan) << text_of(polygons) << x << ' ' << y;
    ASSERT_EQ(length(polygons), static_cast<double>(pixel_edges(plan))) << rows_of(plan);
    for (const Polygon& p : polygons) {
      ASSERT_GE(p.vertices.size(), 4u);
      for (std::size_t i = 0; i < p.vertices.size(); ++i) {
        const Point &a = p.vertices[i], &b = p.vertices[(i + 1) % p.vertices.size()],
                    &c = p.vertices[(i + 2) % p.vertices.size()];
        ASSERT_EQ((a.x_m == b.x_m) + (b.x_m == c.x_m), 1) << "straight pieces are not merged";
        // Where two wall pixels touch at a corner only, the way stays on the free pixel: it turns right.
        const auto bx = static_cast<std::int64_t>(b.x_m), by = static_cast<std::int64_t>(b.y_m);
        if (wall(plan, bx, by) == wall(plan, bx - 1, by - 1) && wall(plan, bx - 1, by) == wall(plan, bx, by - 1) &&
            wall(plan, bx, by) != wall(plan, bx - 1, by)) {
          ++joints;
          ASSERT_LT((b.x_m - a.x_m) * (c.y_m - b.y_m) - (b.y_m - a.y_m) * (c.x_m - b.x_m), 0);
        }
      }
    }
  }
  EXPECT_GT(joints, 10'000u);
}

double distance(const Point& p, const Point& a, const Point& b) {
  const double dx = b.x_m - a.x_m, dy = b.y_m - a.y_m, l2 = dx * dx + dy * dy;
  const double t = l2 == 0 ? 0 : std::clamp(((p.x_m - a.x_m) * dx + (p.y_m - a.y_m) * dy) / l2, 0.0, 1.0);
  return std::hypot(a.x_m + t * dx - p.x_m, a.y_m + t * dy - p.y_m);
}

double distance(const Point& p, const std::vector<Polygon>& polygons) {
  double least = INFINITY;
  for (const Polygon& polygon : polygons)
    for (std::size_t i = 0; i < polygon.vertices.size(); ++i)
      least = std::min(least, distance(p, polygon.vertices[i], polygon.vertices[(i + 1) % polygon.vertices.size()]));
  return least;
}

/// The farthest any point of `of` lies from `from`, sampled every tenth of a pixel.
double farthest(const std::vector<Polygon>& of, const std::vector<Polygon>& from) {
  double most = 0;
  for (const Polygon& p : of)
    for (std::size_t i = 0; i < p.vertices.size(); ++i) {
      const Point &a = p.vertices[i], &b = p.vertices[(i + 1) % p.vertices.size()];
      const int steps = 1 + static_cast<int>(10 * std::hypot(b.x_m - a.x_m, b.y_m - a.y_m));
      for (int k = 0; k < steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        most = std::max(most, distance({a.x_m + t * (b.x_m - a.x_m), a.y_m + t * (b.y_m - a.y_m)}, from));
      }
    }
  return most;
}

TEST(Trace, SimplifiedOutlinesStayWithinTheTolerance) {
  std::mt19937 random(2);
  std::size_t before = 0, after = 0;
  for (int trial = 0; trial < 60; ++trial) {
    // Slanted bars one to four pixels thick: staircases.
    FloorPlan plan;
    plan.resolution_m = plan.resolution_y_m = 1;
    plan.width = plan.height = 60;
    const double angle = 0.001 * (random() % 3142), c = std::cos(angle), s = std::sin(angle);
    const double half = 0.4 + 0.25 * (random() % 7);
    for (std::int64_t y = 0; y < 60; ++y)
      for (std::int64_t x = 0; x < 60; ++x) {
        const double u = c * (static_cast<double>(x) - 30) + s * (static_cast<double>(y) - 30);
        const double v = -s * (static_cast<double>(x) - 30) + c * (static_cast<double>(y) - 30);
        const bool bar = std::abs(v) <= half && std::abs(u) < 25;
        plan.cells.push_back(bar || random() % 2000 == 0 ? PlanCell::occupied : PlanCell::free);
      }
    const std::vector<Polygon> exact = trace(plan, kExact);
    for (const double tolerance : {0.5, 0.75, 2.0}) {
      const std::vector<Polygon> simple = trace(plan, {.simplify_px = tolerance});
      ASSERT_EQ(simple.size(), exact.size());
      EXPECT_LE(farthest(exact, simple), tolerance + 1e-9) << rows_of(plan);
      EXPECT_LE(farthest(simple, exact), tolerance + 1e-9) << rows_of(plan);
      if (tolerance == 0.75) {
        for (const Polygon& p : exact) before += p.vertices.size();
        for (const Polygon& p : simple) after += p.vertices.size();
      }
    }
  }
  EXPECT_LT(after, before * 6 / 10);
}

TEST(Trace, SimplifiedOutlinesKeepJointsAndSmallThings) {
  // Up to three pixels across: a post and a cross stay as they are, whatever the tolerance.
  const FloorPlan small = plan_of("...........\n.##...#....\n.##..###...\n......#....\n...........\n");
  EXPECT_EQ(text_of(trace(small, {.simplify_px = 2})), text_of(trace(small, kExact)));
  // Corners where two walls touch stay on every outline that passes there.
  std::mt19937 random(5);
  std::size_t joints = 0;
  for (int trial = 0; trial < 200; ++trial) {
    FloorPlan plan;
    plan.resolution_m = plan.resolution_y_m = 1;
    plan.width = plan.height = 16;
    for (int i = 0; i < 256; ++i) plan.cells.push_back(random() % 2 == 0 ? PlanCell::occupied : PlanCell::free);
    for (const double tolerance : {0.75, 2.0}) {
      const std::vector<Polygon> simple = trace(plan, {.simplify_px = tolerance});
      for (std::int64_t y = 1; y < 16; ++y)
        for (std::int64_t x = 1; x < 16; ++x) {
          if (wall(plan, x, y) != wall(plan, x - 1, y - 1) || wall(plan, x - 1, y) != wall(plan, x, y - 1) ||
              wall(plan, x, y) == wall(plan, x - 1, y))
            continue;
          ++joints;
          ASSERT_LE(distance({static_cast<double>(x), static_cast<double>(y)}, simple), 1e-9) << x << ' ' << y;
        }
    }
  }
  EXPECT_GT(joints, 5000u);
}

}  // namespace
}  // namespace evigrid::scenes
