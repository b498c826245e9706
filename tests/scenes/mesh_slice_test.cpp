// SPDX-License-Identifier: Apache-2.0
// Cuts through solids whose outlines are known: boxes, cylinders, star-shaped prisms; whether outlines are closed.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <random>
#include <set>

#include "mesh_shapes.hpp"

namespace evigrid::scenes::test {
namespace {

using raycast::Point;
using raycast::Wall;

double length(const Wall& w) { return std::hypot(w.to.x_m - w.from.x_m, w.to.y_m - w.from.y_m); }
double total(const std::vector<Wall>& walls) {
  double sum = 0;
  for (const Wall& w : walls) sum += length(w);
  return sum;
}

/// Even degree at every end point, but for `ridges`: ends of edges that touch the plane from below. Both their faces
/// give the piece, and it is kept once.
void expect_closed(const std::vector<Wall>& walls, const std::set<std::pair<double, double>>& ridges = {}) {
  std::map<std::pair<double, double>, int> degree;
  for (const Wall& w : walls) {
    ++degree[{w.from.x_m, w.from.y_m}];
    ++degree[{w.to.x_m, w.to.y_m}];
  }
  for (const auto& [p, count] : degree) {
    if (ridges.contains(p)) continue;
    EXPECT_EQ(count % 2, 0) << p.first << ", " << p.second;
  }
}

/// Every wall is a side of the polygon, in either direction, and every side is a wall.
void expect_sides(const std::vector<Wall>& walls, const std::vector<Point>& polygon, double tolerance) {
  ASSERT_EQ(walls.size(), polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const auto near = [&](Point p, Point q) { return std::hypot(p.x_m - q.x_m, p.y_m - q.y_m) <= tolerance; };
    const auto is_side = [&](const Wall& w) {
      return (near(w.from, a) && near(w.to, b)) || (near(w.from, b) && near(w.to, a));
    };
    EXPECT_EQ(std::count_if(walls.begin(), walls.end(), is_side), 1) << i;
  }
}

const std::vector<Point> kSquare{{0, 0}, {2, 0}, {2, 1}, {0, 1}};

TEST(Slice, ABoxGivesFourWalls) {
  for (const int layers : {1, 2, 7}) {
    const Mesh box = prism(kSquare, 0, 1, layers);
    // Also exactly through layers of vertices, and at the lower face; the upper face is not below anything.
    for (const double height_m : {0.3, 0.5, 1.0 / 7, 6.0 / 7, 0.999999, 1.0})
      expect_sides(slice(box, {.height_m = height_m}), kSquare, 1e-9);
    for (const double height_m : {0.0, -0.1, 1.0000001})
      EXPECT_TRUE(slice(box, {.height_m = height_m}).empty()) << height_m;
  }
}

TEST(Slice, PlacementScalesTurnsAndMoves) {
  Mesh box = prism(kSquare, 0, 1);
  for (auto& v : box.vertices) v = {v[0] * 1000, v[2] * 1000, -v[1] * 1000};  // millimetres, y up
  const double yaw = 0.7, c = std::cos(yaw), s = std::sin(yaw);
  const auto walls =
      slice(box, {.scale = 0.001, .height_m = 0.4, .T_map_mesh = {5, -3, yaw}, .y_up = true, .material = {0.5, 0.25}});
  std::vector<Point> expected;
  for (const Point& p : kSquare) expected.push_back({5 + c * p.x_m - s * p.y_m, -3 + s * p.x_m + c * p.y_m});
  expect_sides(walls, expected, 1e-9);
  EXPECT_EQ(walls[0].material.critical_incidence_rad, 0.5);
  EXPECT_EQ(walls[0].material.absorption, 0.25);
}

TEST(Slice, ACylinderHasItsSides) {
  for (const int n : {3, 8, 100, 1000}) {
    const auto base = regular(n, 1.5, 0.1);
    expect_sides(slice(prism(base, -1, 1, 5), {.height_m = 0.1}), base, 1e-6);
  }
}

TEST(Slice, StarShapedPrismsAreTheirPolygons) {
  std::mt19937_64 random(11);
  for (int round = 0; round < 100; ++round) {
    const int n = 5 + static_cast<int>(random() % 40);
    std::vector<Point> star = regular(n, 1);
    for (Point& p : star) {
      const double r = std::uniform_real_distribution<>(0.3, 3)(random);
      p = {10 + r * p.x_m, -20 + r * p.y_m};
    }
    Mesh mesh = prism(star, 0, 2, 1 + static_cast<int>(random() % 6));
    std::shuffle(mesh.faces.begin(), mesh.faces.end(), random);
    const auto walls = slice(mesh, {.height_m = round % 3 == 0 ? 1.0 : 0.77});
    expect_sides(walls, star, 1e-6);
    expect_closed(walls);
    // The same as floats, as files often have it.
    for (auto& v : mesh.vertices)
      for (double& x : v) x = static_cast<float>(x);
    expect_sides(slice(mesh, {.height_m = 0.77}), star, 1e-5);
  }
}

TEST(Slice, RandomClosedSolidsHaveClosedOutlines) {
  // A bumpy ball: outlines with vertices exactly in the plane, since heights are rounded to tenths.
  std::mt19937_64 random(5);
  std::int64_t in_plane = 0;
  for (int round = 0; round < 50; ++round) {
    const int rings = 8, n = 12;
    Mesh ball;
    ball.vertices.push_back({0, 0, -1});
    for (int k = 1; k < rings; ++k)
      for (int i = 0; i < n; ++i) {
        const double r = std::uniform_real_distribution<>(0.7, 1.3)(random), t = std::numbers::pi * k / rings;
        const double a = 2 * std::numbers::pi * i / n;
        ball.vertices.push_back(
            {r * std::sin(t) * std::cos(a), r * std::sin(t) * std::sin(a), std::round(-10 * r * std::cos(t)) / 10});
      }
    ball.vertices.push_back({0, 0, 1});
    const auto at = [&](int k, int i) { return static_cast<std::uint32_t>(1 + (k - 1) * n + i % n); };
    for (int i = 0; i < n; ++i) {
      ball.faces.push_back({0, at(1, i + 1), at(1, i)});
      for (int k = 1; k + 1 < rings; ++k) {
        ball.faces.push_back({at(k, i), at(k, i + 1), at(k + 1, i + 1)});
        ball.faces.push_back({at(k, i), at(k + 1, i + 1), at(k + 1, i)});
      }
      ball.faces.push_back(
          {at(rings - 1, i), at(rings - 1, i + 1), static_cast<std::uint32_t>(ball.vertices.size() - 1)});
    }
    for (const double height_m : {-0.5, 0.0, 0.1, 0.3, 0.7}) {
      const auto walls = slice(ball, {.height_m = height_m});
      EXPECT_GT(walls.size(), 3u);
      std::set<std::pair<double, double>> ridges;
      for (const auto& f : ball.faces)
        for (std::size_t k = 0; k < 3; ++k) {
          const Vertex &a = ball.vertices[f[k]], &b = ball.vertices[f[(k + 1) % 3]];
          if (a[2] != height_m || b[2] != height_m) continue;
          ridges.emplace(a[0], a[1]);
          ridges.emplace(b[0], b[1]);
        }
      expect_closed(walls, ridges);
      in_plane +=
          std::count_if(ball.vertices.begin(), ball.vertices.end(), [&](const Vertex& v) { return v[2] == height_m; }) -
          std::ssize(ridges);
    }
  }
  EXPECT_GT(in_plane, 200);  // vertices at the very height, not on a ridge
}

TEST(Slice, AFinelyTessellatedWallIsOnePiece) {
  Mesh wall;  // 10 m at a slant, 200 quads in a row, both sides with diagonals of their own, vertices in float
  const auto quad = [&](double t0, double t1, bool back) {
    const auto first = static_cast<std::uint32_t>(wall.vertices.size());
    for (const double z : {0.0, 2.5})
      for (const double t : {t0, t1})
        wall.vertices.push_back({static_cast<float>(1 + 8 * t), static_cast<float>(2 + 6 * t), z});
    if (back) {
      wall.faces.push_back({first, first + 1, first + 2});
      wall.faces.push_back({first + 1, first + 2, first + 3});
    } else {
      wall.faces.push_back({first, first + 1, first + 3});
      wall.faces.push_back({first, first + 3, first + 2});
    }
  };
  for (int i = 0; i < 200; ++i) {
    quad(i / 200.0, (i + 1) / 200.0, false);
    quad(i / 200.0, (i + 1) / 200.0, true);
  }
  const auto walls = slice(wall, {.height_m = 0.3});
  ASSERT_EQ(walls.size(), 1u);
  EXPECT_NEAR(total(walls), 10, 1e-5);
}

TEST(Slice, AFineCurveStaysACurve) {
  // 200 000 sides of 31 µm: joined to fewer, none farther than the tolerance (2^-22 of 2 m) from the circle's.
  const auto walls = slice(prism(regular(200'000, 1), 0, 1), {.height_m = 0.5});
  EXPECT_LT(walls.size(), 20'000u);
  EXPECT_NEAR(total(walls), 2 * std::numbers::pi, 1e-5);
  for (const Wall& w : walls) {
    const double x = (w.from.x_m + w.to.x_m) / 2, y = (w.from.y_m + w.to.y_m) / 2;
    ASSERT_NEAR(std::hypot(x, y), 1, 3e-6);
    ASSERT_NEAR(std::hypot(w.from.x_m, w.from.y_m), 1, 1e-6);
  }
  expect_closed(walls);
}

TEST(Slice, TheSamePieceTwiceIsKeptOnce) {
  Mesh box = prism(kSquare, 0, 1);
  const auto faces = box.faces;
  for (auto f : faces) box.faces.push_back({f[2], f[1], f[0]});  // double-sided
  expect_sides(slice(box, {.height_m = 0.3}), kSquare, 1e-9);
}

TEST(Slice, AStarOfManyPiecesTakesNoLongTime) {
  constexpr std::uint32_t kRays = 100'000;
  Mesh star;
  star.vertices = {{0, 0, -1}, {0, 0, 1}};
  for (const Point& p : regular(kRays, 1)) star.vertices.push_back({p.x_m, p.y_m, 0.5});
  for (std::uint32_t i = 0; i < kRays; ++i) star.faces.push_back({0, 1, i + 2});
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Wall> walls = slice(star, {.height_m = 0});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  EXPECT_EQ(walls.size(), kRays);  // no joining where so many meet
  star.vertices.resize(2 + 6);
  star.faces.clear();
  for (std::uint32_t i = 0; i < 6; ++i) {
    star.vertices[i + 2] = {std::cos(i * std::numbers::pi / 3), std::sin(i * std::numbers::pi / 3), 0.5};
    star.faces.push_back({0, 1, i + 2});
  }
  EXPECT_EQ(slice(star, {.height_m = 0}).size(), 3u);
}

TEST(Slice, RefusesWhatCannotBe) {
  Mesh box = prism(kSquare, 0, 1);
  EXPECT_THROW((void)slice(box, {.scale = 0}), std::invalid_argument);
  EXPECT_THROW((void)slice(box, {.height_m = NAN}), std::invalid_argument);
  box.faces.push_back({0, 1, 99});
  EXPECT_THROW((void)slice(box, {}), std::invalid_argument);
  EXPECT_TRUE(slice({}, {}).empty());
}

TEST(Slice, RefusesCoordinatesWhoseDifferencesOverflow) {
  const Mesh far{{{1e308, 0, -1e308}, {-1e308, 1, 1e308}, {1e308, -1e308, 1e308}}, {{0, 1, 2}}};
  EXPECT_THROW((void)slice(far, {}), std::invalid_argument);
  EXPECT_THROW((void)slice(prism(kSquare, 0, 1), {.scale = 1e13}), std::invalid_argument);
  EXPECT_FALSE(slice(prism(kSquare, 0, 1), {.scale = 1e7}).empty());
}

}  // namespace
}  // namespace evigrid::scenes::test
