// SPDX-License-Identifier: Apache-2.0
#include "truth/outline.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>

#include "evigrid/scenes/truth.hpp"

namespace evigrid::scenes {
namespace {

using raycast::Point;

void require(bool good, const char* object, std::size_t index, const char* problem) {
  if (!good) throw std::invalid_argument(std::string(object) + " " + std::to_string(index) + ": " + problem);
}

void require_finite(std::initializer_list<double> values, const char* object, std::size_t index) {
  for (const double v : values) require(std::isfinite(v), object, index, "a number is not finite");
}

void add_closed(const std::vector<Point>& v, std::vector<Segment>& segments) {
  for (std::size_t k = 0; k < v.size(); ++k) segments.push_back({v[k], v[(k + 1) % v.size()]});
}

}  // namespace

Outline take_apart(const raycast::World& world) {
  Outline outline;
  for (std::size_t i = 0; i < world.walls.size(); ++i) {
    const raycast::Wall& w = world.walls[i];
    require_finite({w.from.x_m, w.from.y_m, w.to.x_m, w.to.y_m}, "wall", i);
    outline.segments.push_back({w.from, w.to});
  }
  for (std::size_t i = 0; i < world.boxes.size(); ++i) {
    const raycast::Box& box = world.boxes[i];
    require_finite({box.centre.x_m, box.centre.y_m, box.length_m, box.width_m, box.yaw_rad}, "box", i);
    const double c = std::cos(box.yaw_rad), s = std::sin(box.yaw_rad);
    const double l = box.length_m / 2, w = box.width_m / 2;
    const auto corner = [&](double x, double y) {
      return Point{box.centre.x_m + c * x - s * y, box.centre.y_m + s * x + c * y};
    };
    add_closed({corner(-l, -w), corner(l, -w), corner(l, w), corner(-l, w)}, outline.segments);
  }
  for (std::size_t i = 0; i < world.circles.size(); ++i) {
    const raycast::Circle& circle = world.circles[i];
    require_finite({circle.centre.x_m, circle.centre.y_m, circle.radius_m}, "circle", i);
    require(circle.radius_m >= 0, "circle", i, "radius_m is negative");
    outline.rings.push_back({circle.centre, circle.radius_m});
  }
  for (std::size_t i = 0; i < world.polygons.size(); ++i) {
    for (const Point& p : world.polygons[i].vertices) require_finite({p.x_m, p.y_m}, "polygon", i);
    add_closed(world.polygons[i].vertices, outline.segments);
  }
  return outline;
}

Extent extent(const raycast::World& world) {
  const Outline outline = take_apart(world);
  if (outline.segments.empty() && outline.rings.empty()) return {};
  const double inf = std::numeric_limits<double>::infinity();
  Extent e{{inf, inf}, {-inf, -inf}};
  const auto include = [&](Point p, double margin) {
    e.low = {std::min(e.low.x_m, p.x_m - margin), std::min(e.low.y_m, p.y_m - margin)};
    e.high = {std::max(e.high.x_m, p.x_m + margin), std::max(e.high.y_m, p.y_m + margin)};
  };
  for (const Segment& s : outline.segments) {
    include(s.a, 0);
    include(s.b, 0);
  }
  for (const Ring& r : outline.rings) include(r.centre, r.radius_m);
  return e;
}

}  // namespace evigrid::scenes
