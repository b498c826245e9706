// SPDX-License-Identifier: Apache-2.0
// The tour: grid, goals, order, ways between goals, and the ways made straight. A goal whose area the way has already
// come near enough to is left out.
#include "evigrid/scenes/tour.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "tour/goals.hpp"

namespace evigrid::scenes {
namespace {

using raycast::Point;

constexpr double kBin_m = 1;  // about the distance of neighbouring pieces of furniture; speed only

double clearance_of(const Outline& outline, Point p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& s : outline.segments) least = std::min(least, squared_distance(p, p, s));
  for (const Ring& r : outline.rings) least = std::min(least, squared_distance(p, p, r));
  return std::sqrt(least);
}

std::string text(Point p) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "(%.3f, %.3f)", p.x_m, p.y_m);
  return buffer;
}

/// The cell of `allowed` whose centre is nearest to p.
std::optional<CellIndex> nearest_cell(const DriveGrid& grid, const std::vector<std::uint8_t>& allowed, Point p) {
  std::optional<CellIndex> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < allowed.size(); ++i) {
    if (!allowed[i]) continue;
    const Point c = grid.centre(static_cast<CellIndex>(i));
    const double d = (c.x_m - p.x_m) * (c.x_m - p.x_m) + (c.y_m - p.y_m) * (c.y_m - p.y_m);
    if (d < least) {
      least = d;
      best = static_cast<CellIndex>(i);
    }
  }
  return best;
}

/// A drivable cell near the start, in sight of it.
std::optional<CellIndex> cell_of_start(const DriveGrid& grid, const Nearby& nearby, Point start) {
  const auto column = static_cast<std::int64_t>(std::floor(start.x_m / grid.cell_m)) - grid.x;
  const auto row = static_cast<std::int64_t>(std::floor(start.y_m / grid.cell_m)) - grid.y;
  std::vector<std::uint8_t> seen(grid.drivable.size(), 0);
  for (std::int64_t y = std::max<std::int64_t>(row - 3, 0); y <= std::min(row + 3, grid.height - 1); ++y) {
    for (std::int64_t x = std::max<std::int64_t>(column - 3, 0); x <= std::min(column + 3, grid.width - 1); ++x) {
      const auto i = static_cast<CellIndex>(y * grid.width + x);
      seen[i] = grid.drivable[i] && nearby.keeps(start, grid.centre(i), grid.leg_clearance_m);
    }
  }
  return nearest_cell(grid, seen, start);
}

[[noreturn]] void refuse_start(const DriveGrid& grid, const Outline& outline, const TourSpec& spec) {
  const std::optional<CellIndex> place = nearest_cell(grid, main_region(grid), spec.start);
  throw std::invalid_argument("the start " + text(spec.start) + " is " +
                              std::to_string(clearance_of(outline, spec.start)) + " m from a surface, less than " +
                              std::to_string(spec.clearance_m) + " m; " +
                              (place ? "the nearest place that is not is " + text(grid.centre(*place))
                                     : std::string("no place in this world keeps that distance")));
}

/// From each waypoint straight to the last point of the way that can be reached so, found by doubling and halving.
void append_straightened(const std::vector<Point>& way, const DriveGrid& grid, const Nearby& nearby,
                         std::vector<Point>& waypoints) {
  for (std::size_t at = 0; at + 1 < way.size();) {
    const auto straight = [&](std::size_t to) { return nearby.keeps(way[at], way[to], grid.leg_clearance_m); };
    std::size_t good = at + 1, bad = way.size();  // a single step always is
    for (std::size_t stride = 2; at + stride < way.size(); stride *= 2) {
      if (!straight(at + stride)) {
        bad = at + stride;
        break;
      }
      good = at + stride;
    }
    if (bad == way.size() && good + 1 < bad && straight(bad - 1)) good = bad - 1;
    while (good + 1 < bad) {
      const std::size_t middle = good + (bad - good) / 2;
      (straight(middle) ? good : bad) = middle;
    }
    waypoints.push_back(way[good]);
    at = good;
  }
}

}  // namespace

std::vector<Point> make_tour(const raycast::World& world, const TourSpec& spec) {
  if (!std::isfinite(spec.start.x_m) || !std::isfinite(spec.start.y_m))
    throw std::invalid_argument("start is not finite");
  if (!(spec.spacing_m > 0) || !std::isfinite(spec.spacing_m)) throw std::invalid_argument("spacing_m is not positive");
  const Outline outline = take_apart(world);
  const Nearby nearby(outline, std::max(kBin_m, spec.clearance_m));
  const DriveGrid grid = drive_grid(outline, nearby, spec.clearance_m, spec.cell_m, {&spec.start, 1}, spec.most_cells);
  if (!nearby.keeps(spec.start, spec.start, grid.leg_clearance_m)) refuse_start(grid, outline, spec);
  const std::optional<CellIndex> start = cell_of_start(grid, nearby, spec.start);
  std::vector<Point> waypoints{spec.start};
  if (!start) return waypoints;  // a niche that just holds the robot

  std::vector<std::uint32_t> length(grid.drivable.size(), kUnreached);
  std::vector<CellIndex> reachable;
  Spread spread(grid);
  spread.run({*start}, kUnreached - 1, length, [](CellIndex) {});
  for (std::size_t i = 0; i < length.size(); ++i)
    if (length[i] != kUnreached) reachable.push_back(static_cast<CellIndex>(i));

  const auto spacing = static_cast<std::uint32_t>(std::min(spec.spacing_m / grid.cell_m * kStraight, 4e9));
  const Goals goals = choose_goals(grid, *start, reachable, spacing);

  // Cells of each goal's area that no part of the way has come near to yet.
  std::vector<std::uint32_t> left(goals.cells.size(), 0);
  for (const CellIndex i : reachable) ++left[goals.owner[i]];
  std::vector<std::uint32_t>& near = length;  // from here on: way to the tour
  std::fill(near.begin(), near.end(), kUnreached);
  std::vector<std::uint8_t> covered(near.size(), 0);
  const auto cover = [&](const std::vector<CellIndex>& path) {
    spread.run(path, spacing, near, [&](CellIndex i) {
      if (!covered[i]) --left[goals.owner[i]];
      covered[i] = 1;
    });
  };

  Pathfinder finder(grid);
  CellIndex here = *start;
  cover({here});
  for (const std::uint32_t goal : order_goals(grid, goals)) {
    if (left[goal] == 0) continue;
    const std::vector<CellIndex> path = finder.path(here, goals.cells[goal]);
    if (path.empty()) continue;  // farther than a way can be told
    cover(path);
    std::vector<Point> way{waypoints.back()};
    for (const CellIndex i : path) way.push_back(grid.centre(i));
    if (way.size() > 1 && way[0].x_m == way[1].x_m && way[0].y_m == way[1].y_m) way.erase(way.begin());
    append_straightened(way, grid, nearby, waypoints);
    here = goals.cells[goal];
  }
  return waypoints;
}

Point find_start(const raycast::World& world, double clearance_m, double cell_m, std::int64_t most_cells) {
  const Outline outline = take_apart(world);
  const Nearby nearby(outline, std::max(kBin_m, clearance_m));
  const DriveGrid grid = drive_grid(outline, nearby, clearance_m, cell_m, {}, most_cells);
  const std::vector<std::uint8_t> region = main_region(grid);
  std::optional<CellIndex> best;
  for (std::size_t i = 0; i < region.size(); ++i)
    if (region[i] && (!best || grid.clearance_sq[i] > grid.clearance_sq[*best])) best = static_cast<CellIndex>(i);
  if (!best)
    throw std::invalid_argument("no place in this world is " + std::to_string(clearance_m) + " m from every surface");
  return grid.centre(*best);
}

}  // namespace evigrid::scenes
