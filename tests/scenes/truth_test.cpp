// SPDX-License-Identifier: Apache-2.0
// Rasterised worlds against brute force: every cell is asked on its own, by clipping (segments, in rationals of 128
// bits) and by distances of corners (circles), and the flood is a plain search cell by cell.
#include "evigrid/scenes/truth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <random>
#include <stdexcept>
#include <string>

namespace evigrid::scenes {
namespace {

using raycast::Point;
using raycast::World;
__extension__ typedef __int128 Wide;

constexpr std::int64_t kUnit = 65536;

struct Corner {
  std::int64_t x, y;
};
Corner lattice(Point p, double cell_m) {
  return {std::llround(p.x_m / cell_m * kUnit), std::llround(p.y_m / cell_m * kUnit)};
}

/// Separating axes: the square's two and the segment's normal. Exact.
bool segment_meets(Corner a, Corner b, std::int64_t ix, std::int64_t iy) {
  const std::int64_t x0 = ix * kUnit, x1 = x0 + kUnit, y0 = iy * kUnit, y1 = y0 + kUnit;
  if (std::max(a.x, b.x) < x0 || std::min(a.x, b.x) > x1 || std::max(a.y, b.y) < y0 || std::min(a.y, b.y) > y1)
    return false;
  bool left = false, right = false;
  for (const std::int64_t x : {x0, x1}) {
    for (const std::int64_t y : {y0, y1}) {
      const Wide side = Wide{b.x - a.x} * (y - a.y) - Wide{b.y - a.y} * (x - a.x);
      left = left || side >= 0;
      right = right || side <= 0;
    }
  }
  return left && right;
}

bool circle_meets(Corner c, std::int64_t r, std::int64_t ix, std::int64_t iy) {
  const std::int64_t x = ix * kUnit - c.x, y = iy * kUnit - c.y;
  const auto near = [](std::int64_t v) { return std::max<std::int64_t>({v, -v - kUnit, 0}); };
  const auto far = [](std::int64_t v) { return std::max(std::abs(v), std::abs(v + kUnit)); };
  const Wide square = Wide{r} * r;
  return Wide{near(x)} * near(x) + Wide{near(y)} * near(y) <= square &&
         Wide{far(x)} * far(x) + Wide{far(y)} * far(y) >= square;
}

bool is_surface(const World& world, double cell_m, std::int64_t ix, std::int64_t iy) {
  const auto meets = [&](Point a, Point b) { return segment_meets(lattice(a, cell_m), lattice(b, cell_m), ix, iy); };
  for (const auto& w : world.walls)
    if (meets(w.from, w.to)) return true;
  for (const auto& p : world.polygons)
    for (std::size_t k = 0; k < p.vertices.size(); ++k)
      if (meets(p.vertices[k], p.vertices[(k + 1) % p.vertices.size()])) return true;
  for (const auto& box : world.boxes) {
    const double c = std::cos(box.yaw_rad), s = std::sin(box.yaw_rad);
    Point v[4];
    for (int k = 0; k < 4; ++k) {
      const double x = (k == 1 || k == 2 ? 0.5 : -0.5) * box.length_m, y = (k < 2 ? -0.5 : 0.5) * box.width_m;
      v[k] = {box.centre.x_m + c * x - s * y, box.centre.y_m + s * x + c * y};
    }
    for (int k = 0; k < 4; ++k)
      if (meets(v[k], v[(k + 1) % 4])) return true;
  }
  for (const auto& circle : world.circles) {
    const std::int64_t r = std::llround(circle.radius_m / cell_m * kUnit);
    if (circle_meets(lattice(circle.centre, cell_m), r, ix, iy)) return true;
  }
  return false;
}

void expect_same(const World& world, double cell_m, Point inside) {
  const TruthGrid grid = rasterise(world, cell_m, inside);
  ASSERT_EQ(grid.cells.size(), static_cast<std::size_t>(grid.width * grid.height));
  std::vector<TruthCell> slow(grid.cells.size(), TruthCell::solid);
  for (std::int64_t i = 0; i < grid.width * grid.height; ++i)
    if (is_surface(world, cell_m, grid.x + i % grid.width, grid.y + i / grid.width))
      slow[static_cast<std::size_t>(i)] = TruthCell::surface;
  // Nothing on the rim, so nothing beyond it.
  for (std::int64_t x = 0; x < grid.width; ++x) {
    ASSERT_NE(slow[static_cast<std::size_t>(x)], TruthCell::surface);
    ASSERT_NE(slow[static_cast<std::size_t>((grid.height - 1) * grid.width + x)], TruthCell::surface);
  }
  std::queue<std::pair<std::int64_t, std::int64_t>> open;
  open.emplace(static_cast<std::int64_t>(std::floor(inside.x_m / cell_m + 0x1p-18)) - grid.x,
               static_cast<std::int64_t>(std::floor(inside.y_m / cell_m + 0x1p-18)) - grid.y);
  while (!open.empty()) {
    const auto [x, y] = open.front();
    open.pop();
    if (x < 0 || y < 0 || x >= grid.width || y >= grid.height) continue;
    TruthCell& cell = slow[static_cast<std::size_t>(y * grid.width + x)];
    if (cell != TruthCell::solid) continue;
    cell = TruthCell::free;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) open.emplace(x + dx, y + dy);
  }
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < slow.size(); ++i) wrong += slow[i] != grid.cells[i];
  EXPECT_EQ(wrong, 0u);
}

TEST(Truth, RandomWorldsAreThoseOfBruteForce) {
  std::mt19937_64 random(7);
  for (int world_number = 0; world_number < 150; ++world_number) {
    const double cell_m = std::array{0.05, 0.1, 0.0625, 0.37}[static_cast<std::size_t>(world_number % 4)];
    // A third of the numbers lie on borders of cells, a third on the lattice, a third anywhere.
    const auto number = [&](double low, double high) {
      const double v = std::uniform_real_distribution<>(low, high)(random);
      switch (random() % 3) {
        case 0:
          return std::round(v / cell_m) * cell_m;
        case 1:
          return std::round(v / cell_m * 65536) / 65536 * cell_m;
        default:
          return v;
      }
    };
    const auto point = [&] { return Point{number(-3, 3), number(-3, 3)}; };
    World world;
    for (int i = 0; i < 4; ++i) world.walls.push_back({point(), point(), {}});
    const Point at = point();
    world.walls.push_back({at, {at.x_m, number(-3, 3)}, {}});
    world.walls.push_back({at, {number(-3, 3), at.y_m}, {}});
    world.walls.push_back({at, at, {}});
    world.boxes.push_back({point(), number(0, 2), number(0, 2), number(-3, 3), {}});
    world.boxes.push_back({point(), std::round(number(1, 9)) * cell_m, std::round(number(1, 9)) * cell_m, 0, {}});
    for (int i = 0; i < 3; ++i) world.circles.push_back({point(), std::abs(number(0, 2)), {}});
    world.circles.push_back({point(), 0, {}});
    world.polygons.push_back({{point(), point(), point(), point()}, {}});
    Point inside = point();
    while (is_surface(world, cell_m, static_cast<std::int64_t>(std::floor(inside.x_m / cell_m + 0x1p-18)),
                      static_cast<std::int64_t>(std::floor(inside.y_m / cell_m + 0x1p-18))))
      inside = point();
    expect_same(world, cell_m, inside);
  }
}

TEST(Truth, AWallOnABorderIsInBothNeighbours) {
  World world;
  world.walls.push_back({{0.3, 0.12}, {0.3, 0.18}, {}});  // 0.3 / 0.1 is a little less than 3
  const TruthGrid grid = rasterise(world, 0.1, {0.05, 0.05});
  EXPECT_EQ(grid.at(2, 1), TruthCell::surface);
  EXPECT_EQ(grid.at(3, 1), TruthCell::surface);
  EXPECT_EQ(grid.at(1, 1), TruthCell::free);
  EXPECT_EQ(grid.at(2, 0), TruthCell::free);
  EXPECT_EQ(std::count(grid.cells.begin(), grid.cells.end(), TruthCell::surface), 2);
}

TEST(Truth, WithinAClosedOutlineIsSolid) {
  World world;
  world.polygons.push_back({{{0.05, 0.05}, {4.05, 0.05}, {4.05, 3.05}, {0.05, 3.05}}, {}});
  world.circles.push_back({{2, 1.5}, 0.5, {}});
  const TruthGrid grid = rasterise(world, 0.1, {0.5, 0.5});
  EXPECT_EQ(grid.x, -1);
  EXPECT_EQ(grid.y, -1);
  EXPECT_EQ(grid.width, 43);
  EXPECT_EQ(grid.height, 33);
  EXPECT_EQ(grid.at(20, 15), TruthCell::solid);
  EXPECT_EQ(grid.at(5, 5), TruthCell::free);
  EXPECT_EQ(grid.at(-1, -1), TruthCell::solid);
  EXPECT_EQ(grid.at(0, 10), TruthCell::surface);
  // Seen from within the pole it is the other way round.
  EXPECT_EQ(rasterise(world, 0.1, {2, 1.5}).at(5, 5), TruthCell::solid);
}

TEST(Truth, CoversThePointInsideAndRunsOutOfAnOpenWorld) {
  World world;
  world.walls.push_back({{0, 0}, {1, 0}, {}});
  const TruthGrid grid = rasterise(world, 0.5, {5.2, -3.2});
  EXPECT_EQ(grid.at(10, -7), TruthCell::free);
  EXPECT_EQ(grid.at(grid.x, grid.y), TruthCell::free);
  EXPECT_EQ(grid.at(grid.x + grid.width - 1, grid.y + grid.height - 1), TruthCell::free);
  const TruthGrid empty = rasterise({}, 0.5, {5.2, -3.2});
  EXPECT_EQ(empty.at(10, -7), TruthCell::free);
}

TEST(Truth, FarFromTheOriginItIsTheSameRoom) {
  std::int64_t near_count = 0;
  for (const double away_m : {0.0, 512.0, 6.4e6}) {
    World world;
    world.boxes.push_back({{away_m + 2, -away_m + 2}, 3, 2, 0.5, {}});
    world.circles.push_back({{away_m + 2, -away_m + 2}, 0.5, {}});
    const TruthGrid grid = rasterise(world, 0.0625, {away_m + 2, -away_m + 2.8});
    const std::int64_t count = std::count(grid.cells.begin(), grid.cells.end(), TruthCell::surface);
    if (away_m == 0) near_count = count;
    EXPECT_GT(count, 200);
    EXPECT_EQ(count, near_count) << away_m;
  }
}

TEST(Truth, ALongWallNeedsMoreThan64Bits) {
  World world;
  world.walls.push_back({{0, 0}, {2e5, 0.1}, {}});  // 2·10⁷ cells: dx·dy of the lattice is beyond 2^63 on the way
  const TruthGrid grid = rasterise(world, 0.01, {0, -0.02});
  EXPECT_EQ(grid.at(0, 0), TruthCell::surface);
  EXPECT_EQ(grid.at(9'999'999, 4), TruthCell::surface);
  EXPECT_EQ(grid.at(10'000'001, 5), TruthCell::surface);
  EXPECT_EQ(grid.at(10'000'001, 4), TruthCell::free);
}

template <class Error>
std::string refusal(const World& world, double cell_m, Point inside) {
  try {
    (void)rasterise(world, cell_m, inside);
  } catch (const Error& e) {
    return e.what();
  }
  return "none";
}

TEST(Truth, RefusesWhatCannotBe) {
  World world;
  world.walls.push_back({{0, 0}, {1e4, 1e4}, {}});
  EXPECT_NE(refusal<std::length_error>(world, 0.01, {1, 0}).find("cells of 0.01"), std::string::npos);
  EXPECT_NE(refusal<std::length_error>(world, 1e-9, {1, 0}).find("too far"), std::string::npos);
  EXPECT_NE(refusal<std::invalid_argument>(world, 1, {5, 5}).find("holds a surface"), std::string::npos);
  EXPECT_NE(refusal<std::invalid_argument>(world, 0, {5, 1}).find("cell_m"), std::string::npos);
  world.circles.push_back({{NAN, 0}, 1, {}});
  EXPECT_NE(refusal<std::invalid_argument>(world, 1, {5, 1}).find("circle 0"), std::string::npos);
}

TEST(Truth, ExtentIsOfAllSurfaces) {
  World world;
  EXPECT_EQ(extent(world).high.x_m, 0);
  world.circles.push_back({{1, 2}, 3, {}});
  world.walls.push_back({{-4, 0}, {0, 0}, {}});
  const Extent e = extent(world);
  EXPECT_EQ(e.low.x_m, -4);
  EXPECT_EQ(e.low.y_m, -1);
  EXPECT_EQ(e.high.x_m, 4);
  EXPECT_EQ(e.high.y_m, 5);
}

TEST(Truth, ThePlacesOffSurfacesAreThoseThatCanBeFilledFrom) {
  World world;
  world.polygons.push_back({{{0, 0}, {4, 0}, {4, 3}, {0, 3}}, {}});
  world.boxes.push_back({{1, 1}, 0.4, 0.4, 0.3, {}});
  std::mt19937_64 random(3);
  std::uniform_real_distribution<> x(-0.2, 4.2), y(-0.2, 3.2);
  int on = 0;
  for (int i = 0; i < 300; ++i) {
    const Point p{x(random), y(random)};
    const bool off = first_off_surfaces(world, 0.3, std::span(&p, 1)).has_value();
    if (off) {
      EXPECT_NO_THROW((void)rasterise(world, 0.3, p));
    } else {
      EXPECT_THROW((void)rasterise(world, 0.3, p), std::invalid_argument);
    }
    on += !off;
  }
  EXPECT_GT(on, 30);
  const Point points[]{{0, 1}, {4, 2}, {2, 2}, {3, 2}};
  const auto first = first_off_surfaces(world, 0.3, points);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->x_m, 2);
}

}  // namespace
}  // namespace evigrid::scenes
