// SPDX-License-Identifier: Apache-2.0
#include "paper/li2014/path_agent.hpp"

#include <algorithm>
#include <cmath>

#include "navigate/distance_transform.hpp"
#include "paper/points.hpp"

namespace evigrid::driver {
namespace {

constexpr float kNearWeight = 4;    // how much dearer a step is at the edge of what is blocked
constexpr double kNear_m = 0.15;    // and as far beyond it as this
constexpr double kAxis_m = 1;       // echoes from farther: the cone is wider than the body, its axis tells no place
constexpr float kWithinBody = 100;  // a step on blocked ground, from where the robot already stands

}  // namespace

double distance_to_line(raycast::Point p, raycast::Point a, raycast::Point b) {
  const double dx = b.x_m - a.x_m, dy = b.y_m - a.y_m, square = dx * dx + dy * dy;
  const double t = square == 0 ? 0 : std::clamp(((p.x_m - a.x_m) * dx + (p.y_m - a.y_m) * dy) / square, 0.0, 1.0);
  return distance(p, {a.x_m + t * dx, a.y_m + t * dy});
}

bool PathAgent::needs_plan(const std::vector<raycast::Point>& echoes, raycast::Point at) const {
  if (goals_.empty()) return true;
  return std::any_of(echoes.begin(), echoes.end(), [&](raycast::Point e) {
    if (distance(e, at) > kAxis_m) return false;
    raycast::Point from = at;
    for (const raycast::Point& to : goals_) {
      if (distance_to_line(e, from, to) < limits_.radius_m + limits_.guard_m) return true;
      from = to;
    }
    return false;
  });
}

bool PathAgent::plan(const Map& map, raycast::Point at, raycast::Point goal) {
  goals_.clear();
  std::vector<std::uint8_t> occupied = occupied_cells(map, field_);
  const int width = static_cast<int>(field_.rect.width), height = static_cast<int>(field_.rect.height);
  const double body = limits_.radius_m / field_.cell_m;
  const GridCell start = field_.cell(at), end = field_.cell(goal);
  for (int y = 0; y < height; ++y) {  // where the robot stands nothing else does
    for (int x = 0; x < width; ++x) {
      if (std::hypot(x - start.x, y - start.y) <= body) occupied[field_.index({x, y})] = 0;
    }
  }
  const auto squares = squared_distances(occupied, width, height);
  for (const double margin_m :
       {limits_.margin_m, limits_.guard_m, 0.0, -0.05, -0.1}) {  // the narrower the less there is room
    const double blocked = (limits_.radius_m + margin_m) / field_.cell_m, near = kNear_m / field_.cell_m;
    CostGrid grid(width, height);
    for (std::size_t i = 0; i < grid.cost.size(); ++i) {
      const double d = squares[i] < 0 ? INFINITY : std::sqrt(static_cast<double>(squares[i]));
      if (d < blocked) {
        const GridCell c = grid.cell(i);
        const bool beside = std::hypot(c.x - start.x, c.y - start.y) <= body / 2;
        grid.cost[i] = beside ? kWithinBody : kBlocked;
      } else if (d < blocked + near) {
        grid.cost[i] = 1 + kNearWeight * static_cast<float>(1 - (d - blocked) / near);
      }
    }
    if (!grid.free(end) || !grid.free(start)) continue;
    const GridPath path = planner_.find(grid, start, end);
    if (!path.found()) continue;
    for (const GridCell c : corners(path.cells)) goals_.push_back(field_.centre(c));
    if (!goals_.empty()) goals_.erase(goals_.begin());  // where it stands
    if (!goals_.empty()) goals_.back() = goal;
    return !goals_.empty();
  }
  return false;
}

std::optional<raycast::Point> PathAgent::next_goal(raycast::Point at, double reached_m) {
  while (goals_.size() > 1 && distance(at, goals_.front()) <= reached_m) goals_.erase(goals_.begin());
  if (goals_.empty()) return std::nullopt;
  return goals_.front();
}

}  // namespace evigrid::driver
