// SPDX-License-Identifier: Apache-2.0
// Light does not pass walls: dense rays from free pixels in traced plans, against a walk over the pixels themselves.
// With exact outlines the ranges are equal; with simplified ones, a ray that goes farther must have brushed past the
// very end or edge of something (the pixels let a ray pass there that runs beside it, within the tolerance), and it
// must never come out in another room.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>
#include <random>

#include "evigrid/raycast/scene.hpp"
#include "plan_files.hpp"

namespace evigrid::scenes {
namespace {

bool wall(const FloorPlan& plan, std::int64_t x, std::int64_t y) {
  return x >= 0 && y >= 0 && x < plan.width && y < plan.height && plan.at(x, y) == PlanCell::occupied;
}

/// First wall pixel on the ray (pixels of 1 m), by a walk from pixel to pixel; +∞ when the image ends before. Pixels
/// are closed: a ray through a corner is stopped by any of the pixels there.
double pixel_range(const FloorPlan& plan, double x, double y, double angle) {
  const double dx = std::cos(angle), dy = std::sin(angle);
  const std::int64_t sx = dx > 0 ? 1 : -1, sy = dy > 0 ? 1 : -1;
  auto ix = static_cast<std::int64_t>(std::floor(x)), iy = static_cast<std::int64_t>(std::floor(y));
  while (ix >= -1 && iy >= -1 && ix <= plan.width && iy <= plan.height) {
    const double tx = dx == 0 ? INFINITY : (static_cast<double>(ix + (dx > 0)) - x) / dx;
    const double ty = dy == 0 ? INFINITY : (static_cast<double>(iy + (dy > 0)) - y) / dy;
    const double t = std::min(tx, ty);
    if (std::abs(tx - ty) < 1e-9) {
      if (wall(plan, ix + sx, iy) || wall(plan, ix, iy + sy)) return t;
      ix += sx;
      iy += sy;
    } else if (tx < ty) {
      ix += sx;
    } else {
      iy += sy;
    }
    if (wall(plan, ix, iy)) return t;
  }
  return INFINITY;
}

FloorPlan empty_plan(std::int64_t side) {
  FloorPlan plan;
  plan.resolution_m = plan.resolution_y_m = 1;
  plan.width = plan.height = side;
  plan.cells.resize(static_cast<std::size_t>(side * side));
  return plan;
}

void set(FloorPlan& plan, std::int64_t x, std::int64_t y) {
  if (x >= 0 && y >= 0 && x < plan.width && y < plan.height)
    plan.cells[static_cast<std::size_t>(y * plan.width + x)] = PlanCell::occupied;
}

/// One pixel thick: 8-connected (Bresenham), which is the thinnest wall there is.
void line(FloorPlan& plan, double x0, double y0, double x1, double y1) {
  const int steps = static_cast<int>(std::max(std::abs(x1 - x0), std::abs(y1 - y0)));
  for (int i = 0; i <= steps; ++i) {
    const double t = steps == 0 ? 0 : static_cast<double>(i) / steps;
    set(plan, std::lround(x0 + t * (x1 - x0)), std::lround(y0 + t * (y1 - y0)));
  }
}

/// Walls through and through at random angles, one to three pixels thick; posts; specks.
FloorPlan random_plan(std::mt19937& random) {
  constexpr int side = 90;
  FloorPlan plan = empty_plan(side);
  const auto anywhere = [&] { return static_cast<double>(random() % side); };
  for (int i = 0; i < 5; ++i) {
    const double x0 = anywhere(), y0 = anywhere(), x1 = anywhere(), y1 = anywhere();
    for (unsigned k = 0, thick = 1 + random() % 3; k < thick; ++k) line(plan, x0 + k, y0, x1 + k, y1);
  }
  for (int i = 0; i < 2; ++i) line(plan, 0, anywhere(), side - 1, anywhere());  // divide the plan
  for (int i = 0; i < 20; ++i) set(plan, random() % side, random() % side);
  for (int i = 0; i < 4; ++i) {
    const auto x = random() % side, y = random() % side;
    for (unsigned k = 0; k < 9; ++k) set(plan, x + k % 3, y + k / 3);
  }
  for (int i = 0; i < side; ++i)
    for (const auto& [x, y] : {std::pair{i, 0}, {i, side - 1}, {0, i}, {side - 1, i}}) set(plan, x, y);
  return plan;
}

/// Number of the 4-connected room of each pixel; 0 on walls.
std::vector<int> rooms_of(const FloorPlan& plan) {
  std::vector<int> room(plan.cells.size());
  std::vector<std::int64_t> open;
  int count = 0;
  for (std::int64_t start = 0; start < plan.width * plan.height; ++start) {
    if (room[static_cast<std::size_t>(start)] != 0 || wall(plan, start % plan.width, start / plan.width)) continue;
    ++count;
    open.assign(1, start);
    while (!open.empty()) {
      const std::int64_t at = open.back(), x = at % plan.width, y = at / plan.width;
      open.pop_back();
      if (room[static_cast<std::size_t>(at)] != 0) continue;
      room[static_cast<std::size_t>(at)] = count;
      for (const auto& [nx, ny] : {std::pair{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}})
        if (nx >= 0 && ny >= 0 && nx < plan.width && ny < plan.height && !wall(plan, nx, ny))
          open.push_back(ny * plan.width + nx);
    }
  }
  return room;
}

raycast::Scene scene_of(const FloorPlan& plan, double simplify_px) {
  raycast::World world;
  world.polygons = trace(plan, {.simplify_px = simplify_px});
  return raycast::Scene(world);
}

/// Whether the pixels let something pass that winds its way beside the ray, never farther off than `margin`, as far as
/// `range`. What passes is a point on a lattice along and across the ray; it goes forward or sideways, never through a
/// wall pixel nor between two that touch. A wall across the ray stops it wherever it is; the end of one does not.
bool winds_past(const FloorPlan& plan, double x, double y, double angle, double range, double margin) {
  constexpr int side = 8;
  const double c = std::cos(angle), s = std::sin(angle), across = margin / side, along = 0.1;
  const auto blocked = [&](double u, double v, double turn, double step) {
    return pixel_range(plan, x + c * u - s * v, y + s * u + c * v, angle + turn) < step;
  };
  std::array<bool, 2 * side + 1> open{};
  open[side] = true;
  for (double u = 0; u < range; u += along) {
    for (int k = 1; k <= 2 * side; ++k)
      if (open[k - 1] && !open[k]) open[k] = !blocked(u, across * (k - 1 - side), std::numbers::pi / 2, across);
    for (int k = 2 * side - 1; k >= 0; --k)
      if (open[k + 1] && !open[k]) open[k] = !blocked(u, across * (k + 1 - side), -std::numbers::pi / 2, across);
    for (int k = 0; k <= 2 * side; ++k)
      if (open[k]) open[k] = !blocked(u, across * (k - side), 0, along);
  }
  return std::any_of(open.begin(), open.end(), [](bool b) { return b; });
}

bool near_wall(const FloorPlan& plan, std::int64_t x, std::int64_t y, std::int64_t reach) {
  for (std::int64_t v = -reach; v <= reach; ++v)
    for (std::int64_t u = -reach; u <= reach; ++u)
      if (wall(plan, x + u, y + v)) return true;
  return false;
}

TEST(PlanRays, ExactOutlinesGiveTheRangesOfThePixels) {
  std::mt19937 random(3);
  std::size_t rays = 0, hits = 0;
  double worst = 0;
  for (int trial = 0; trial < 12; ++trial) {
    FloorPlan plan = empty_plan(40);
    for (PlanCell& cell : plan.cells) cell = random() % 100 < 12 ? PlanCell::occupied : PlanCell::free;
    const raycast::Scene scene = scene_of(plan, 0);
    for (int i = 0; i < 4000; ++i) {
      const std::int64_t x = random() % 40, y = random() % 40;
      if (wall(plan, x, y)) continue;
      // Every eighth ray along an axis or a diagonal, exactly through pixel corners.
      const double px = static_cast<double>(x) + 0.5, py = static_cast<double>(y) + 0.5;
      const double angle = i % 8 == 0 ? std::numbers::pi / 4 * (random() % 8) : 1e-6 * (random() % 6283185);
      const double expected = pixel_range(plan, px, py, angle), range = scene.ray_range(px, py, angle, 100);
      ++rays;
      ASSERT_EQ(std::isinf(expected), std::isinf(range)) << px << ' ' << py << ' ' << angle << '\n' << rows_of(plan);
      if (std::isinf(range)) continue;
      ++hits;
      worst = std::max(worst, std::abs(range - expected));
      ASSERT_NEAR(range, expected, 1e-9) << px << ' ' << py << ' ' << angle << '\n' << rows_of(plan);
    }
  }
  EXPECT_GT(hits, rays / 2);
  RecordProperty("worst_m", std::to_string(worst));
}

TEST(PlanRays, NothingIsSeenThroughTwoWallsThatTouchAtACorner) {
  FloorPlan plan = empty_plan(20);
  for (int i = 0; i < 20; ++i) set(plan, i, i);
  for (const double simplify : {0.0, 0.75}) {
    const raycast::Scene scene = scene_of(plan, simplify);
    for (int i = 0; i < 20'000; ++i) {
      const double angle = 1.5 * std::numbers::pi + 1e-4 * (i - 10'000) * 0.7;  // across the diagonal from above
      const double range = scene.ray_range(7.5, 12.5, angle, 100), reached = range * std::cos(angle) + 7.5;
      if (pixel_range(plan, 7.5, 12.5, angle) < 100) {
        ASSERT_LT(range, 100) << angle << ' ' << simplify;
        ASSERT_NEAR(12.5 + range * std::sin(angle), reached, 1.0 + 1e-9);  // on the diagonal, within a pixel
      }
    }
  }
}

TEST(PlanRays, SimplifiedOutlinesLeakNoLight) {
  std::mt19937 random(4);
  constexpr double tolerance = 0.75;
  std::size_t rays = 0, farther = 0, unexplained = 0, nearer = 0, beyond = 0;
  double sum = 0;
  for (int trial = 0; trial < 25; ++trial) {
    const FloorPlan plan = random_plan(random);
    const std::vector<int> room = rooms_of(plan);
    const raycast::Scene simple = scene_of(plan, tolerance);
    for (int from = 0; from < 40; ++from) {
      const std::int64_t x = random() % plan.width, y = random() % plan.height;
      if (near_wall(plan, x, y, 2)) continue;  // the start itself must not be beyond a shifted outline
      const double px = static_cast<double>(x) + 0.5, py = static_cast<double>(y) + 0.5;
      for (int i = 0; i < 720; ++i) {
        const double angle = std::numbers::pi / 360 * i + 1e-3, c = std::cos(angle), s = std::sin(angle);
        const double exact = pixel_range(plan, px, py, angle), range = simple.ray_range(px, py, angle, 1000);
        ++rays;
        sum += std::abs(range - exact);
        // The last two pixels before the end lie in the room of the start, or on its walls.
        ASSERT_LT(range, 1000) << "the ray left the plan at " << px << ' ' << py << ' ' << angle << '\n'
                               << rows_of(plan);
        const auto hx = static_cast<std::int64_t>(std::floor(px + c * range)),
                   hy = static_cast<std::int64_t>(std::floor(py + s * range));
        bool own = false;
        for (std::int64_t v = -1; v <= 1; ++v)
          for (std::int64_t u = -1; u <= 1; ++u)
            if (hx + u >= 0 && hy + v >= 0 && hx + u < plan.width && hy + v < plan.height)
              own |= room[static_cast<std::size_t>((hy + v) * plan.width + hx + u)] ==
                     room[static_cast<std::size_t>(y * plan.width + x)];
        if (!own) ++beyond;
        if (range < exact - 2 * tolerance) ++nearer;
        if (range <= exact + tolerance + 0.05) continue;
        ++farther;
        if (!winds_past(plan, px, py, angle, range - 3 * tolerance, tolerance + 0.05)) ++unexplained;
      }
    }
  }
  std::cout << "[          ] " << rays << " rays: " << farther << " go farther than the tolerance, " << unexplained
            << " of them through something; " << nearer << " end earlier by more than 2 tolerances; " << beyond
            << " end in another room; mean difference " << sum / static_cast<double>(rays) << " px\n";
  EXPECT_GT(rays, 300'000u);
  EXPECT_EQ(beyond, 0u);
  EXPECT_EQ(unexplained, 0u);
}

}  // namespace
}  // namespace evigrid::scenes
