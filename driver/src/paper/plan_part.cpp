// SPDX-License-Identifier: Apache-2.0
#include "paper/plan_part.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace evigrid::driver {
namespace {

using raycast::Point;

struct Window {
  Point low, high;
};

/// What lies in the window of a piece of wall (Liang & Barsky 1984).
std::optional<raycast::Wall> cut(const raycast::Wall& wall, const Window& w) {
  const double dx = wall.to.x_m - wall.from.x_m, dy = wall.to.y_m - wall.from.y_m;
  double begin = 0, end = 1;
  const auto side = [&](double step, double room) {  // inside is step · t <= room
    if (step == 0) return room >= 0;
    if (step < 0) {
      begin = std::max(begin, room / step);
    } else {
      end = std::min(end, room / step);
    }
    return begin <= end;
  };
  if (!side(-dx, wall.from.x_m - w.low.x_m) || !side(dx, w.high.x_m - wall.from.x_m) ||
      !side(-dy, wall.from.y_m - w.low.y_m) || !side(dy, w.high.y_m - wall.from.y_m))
    return std::nullopt;
  const auto at = [&](double t) { return Point{wall.from.x_m + t * dx, wall.from.y_m + t * dy}; };
  return raycast::Wall{begin > 0 ? at(begin) : wall.from, end < 1 ? at(end) : wall.to, wall.material};
}

}  // namespace

std::array<Point, 4> corners(const raycast::Box& b) {
  const double c = std::cos(b.yaw_rad), s = std::sin(b.yaw_rad);
  std::array<Point, 4> out{{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
  for (Point& p : out) {
    const double x = p.x_m * b.length_m / 2, y = p.y_m * b.width_m / 2;
    p = {b.centre.x_m + c * x - s * y, b.centre.y_m + s * x + c * y};
  }
  return out;
}

raycast::World part_around(const raycast::World& world, const std::vector<Point>& way, double reach_m) {
  Window w{way.front(), way.front()};
  for (const Point& p : way) {
    w.low = {std::min(w.low.x_m, p.x_m), std::min(w.low.y_m, p.y_m)};
    w.high = {std::max(w.high.x_m, p.x_m), std::max(w.high.y_m, p.y_m)};
  }
  w.low = {w.low.x_m - reach_m, w.low.y_m - reach_m}, w.high = {w.high.x_m + reach_m, w.high.y_m + reach_m};
  raycast::World out;
  const Window meets = w;
  for (const raycast::Circle& c : world.circles) {
    const double x = std::clamp(c.centre.x_m, meets.low.x_m, meets.high.x_m),
                 y = std::clamp(c.centre.y_m, meets.low.y_m, meets.high.y_m);
    if (std::hypot(c.centre.x_m - x, c.centre.y_m - y) > c.radius_m) continue;
    out.circles.push_back(c);
    w.low = {std::min(w.low.x_m, c.centre.x_m - c.radius_m), std::min(w.low.y_m, c.centre.y_m - c.radius_m)};
    w.high = {std::max(w.high.x_m, c.centre.x_m + c.radius_m), std::max(w.high.y_m, c.centre.y_m + c.radius_m)};
  }
  const auto add = [&](const raycast::Wall& wall) {
    if (const auto inside = cut(wall, w)) out.walls.push_back(*inside);
  };
  const auto add_outline = [&](const auto& vertices, const raycast::Material& material) {
    for (std::size_t i = 0; i < vertices.size(); ++i) add({vertices[i], vertices[(i + 1) % vertices.size()], material});
  };
  for (const raycast::Wall& wall : world.walls) add(wall);
  for (const raycast::Box& b : world.boxes) add_outline(corners(b), b.material);
  for (const raycast::Polygon& p : world.polygons) add_outline(p.vertices, p.material);
  out.polygons.push_back({{w.low, {w.high.x_m, w.low.y_m}, w.high, {w.low.x_m, w.high.y_m}}, {}});
  return out;
}

}  // namespace evigrid::driver
