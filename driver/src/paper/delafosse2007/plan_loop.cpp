// SPDX-License-Identifier: Apache-2.0
#include "paper/delafosse2007/plan_loop.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "error.hpp"

namespace evigrid::driver {
namespace {

using raycast::Point;

constexpr double kLeastTurn_rad = 45 * std::numbers::pi / 180;
constexpr double kOut_m = 25, kLeastWay_m = 1;
constexpr double kBeforeEdge_m = 0.02;  // in sight: nothing before it

struct Corner {
  Point at;
  double turn_rad;
};

/// The point `arm` along the outline from vertex i, forwards (step 1) or back (step n − 1).
Point along(const std::vector<Point>& v, std::size_t i, std::size_t step, double arm) {
  Point at = v[i];
  for (std::size_t k = 0; k < v.size(); ++k) {
    const Point& next = v[(i + step) % v.size()];
    const double d = std::hypot(next.x_m - at.x_m, next.y_m - at.y_m);
    if (d >= arm) return {at.x_m + arm / d * (next.x_m - at.x_m), at.y_m + arm / d * (next.y_m - at.y_m)};
    arm -= d;
    at = next;
    i = (i + step) % v.size();
  }
  return at;
}

}  // namespace

std::vector<Point> closed_loop(const PaperWorld& building, PlanWays& ways, const std::vector<Point>& landmarks,
                               double reach_m, bool from_start, const std::string& plan) {
  const std::vector<Point>& tour = building.scene.trajectory.waypoints;
  const double all_m = length_of(tour);
  const auto in_sight = [&](Point at) {
    return static_cast<std::size_t>(std::count_if(landmarks.begin(), landmarks.end(), [&](Point p) {
      const double dx = p.x_m - at.x_m, dy = p.y_m - at.y_m, d = std::hypot(dx, dy);
      return d <= reach_m &&
             building.caster->ray_range(at.x_m, at.y_m, std::atan2(dy, dx), reach_m + 1) >= d - kBeforeEdge_m;
    }));
  };
  const double best_m = from_start ? 0 : best_stretch(tour, kOut_m, in_sight);
  std::vector<Point> loop = stretch_of(tour, best_m, std::min(best_m + kOut_m, all_m));
  if (length_of(loop) < kLeastWay_m)
    throw InputError(plan + ": the robot has nowhere to go: all that it can reach lies within a metre");
  const std::vector<Point> back = ways.find(loop.back(), loop.front());
  if (back.empty()) throw InputError(plan + ": no way leads back to where the loop began");
  loop.insert(loop.end(), back.begin() + 1, back.end());
  return loop;
}

std::vector<Point> standing_corners(const raycast::World& world, const PlanWays& ways, const std::vector<Point>& way,
                                    double reach_m) {
  const auto x = std::minmax_element(way.begin(), way.end(), [](Point a, Point b) { return a.x_m < b.x_m; });
  const auto y = std::minmax_element(way.begin(), way.end(), [](Point a, Point b) { return a.y_m < b.y_m; });
  const auto near = [&](Point p) {
    return p.x_m >= x.first->x_m - reach_m && p.x_m <= x.second->x_m + reach_m && p.y_m >= y.first->y_m - reach_m &&
           p.y_m <= y.second->y_m + reach_m && ways.beside_free(p);
  };
  std::vector<Corner> all;
  for (const raycast::Polygon& p : world.polygons) {
    const std::size_t n = p.vertices.size();
    for (std::size_t i = 0; n > 2 && i < n; ++i) {
      if (!near(p.vertices[i])) continue;
      const Point &at = p.vertices[i], before = along(p.vertices, i, n - 1, kArm_m),
                  after = along(p.vertices, i, 1, kArm_m);
      const double turn = std::abs(std::remainder(
          std::atan2(after.y_m - at.y_m, after.x_m - at.x_m) - std::atan2(at.y_m - before.y_m, at.x_m - before.x_m),
          2 * std::numbers::pi));
      if (turn >= kLeastTurn_rad) all.push_back({at, turn});
    }
  }
  for (const raycast::Wall& w : world.walls)
    for (const Point& end : {w.from, w.to})
      if (near(end)) all.push_back({end, std::numbers::pi});
  // The same order everywhere: the angles of equal corners differ by rounding alone.
  for (Corner& c : all) c.turn_rad = std::round(c.turn_rad * 1e6) * 1e-6;
  std::stable_sort(all.begin(), all.end(), [](const Corner& a, const Corner& b) { return a.turn_rad > b.turn_rad; });
  std::vector<Point> out;
  for (const Corner& c : all) {
    const bool alone = std::all_of(out.begin(), out.end(), [&](const Point& p) {
      return std::hypot(p.x_m - c.at.x_m, p.y_m - c.at.y_m) >= kApart_m;
    });
    if (alone) out.push_back(c.at);
  }
  return out;
}

}  // namespace evigrid::driver
