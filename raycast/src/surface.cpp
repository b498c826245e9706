// SPDX-License-Identifier: Apache-2.0
#include "surface.hpp"

#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "tolerance.hpp"

namespace evigrid::raycast {
namespace {

void require(bool good, const char* object, std::size_t index, const char* problem) {
  if (!good) throw std::invalid_argument(std::string(object) + " " + std::to_string(index) + ": " + problem);
}

bool finite(std::initializer_list<double> values) {
  for (double v : values)
    if (!std::isfinite(v)) return false;
  return true;
}

Surface with_material(Surface s, const Material& material, const char* object, std::size_t index) {
  const double critical = material.critical_incidence_rad;
  require(critical >= 0 && critical <= std::numbers::pi / 2, object, index,
          "critical_incidence_rad is outside [0, pi/2]");
  const double closed = critical + kEdgeSlack_rad;
  const bool every = closed >= std::numbers::pi / 2;
  require(material.absorption >= 0 && material.absorption < 1, object, index, "absorption is outside [0, 1)");
  s.critical_incidence_rad = critical;
  s.sin_critical = every ? 1 : std::sin(closed);
  s.tan_critical = every ? std::numeric_limits<double>::infinity() : std::tan(closed);
  s.absorption = material.absorption;
  s.heard_share = std::sqrt(1 - material.absorption);
  return s;
}

Surface segment(Point from, Point to) {
  return {.kind = Surface::Kind::segment, .a = {from.x_m, from.y_m}, .b = {to.x_m, to.y_m}};
}

}  // namespace

std::vector<Surface> take_apart(const World& world) {
  std::vector<Surface> surfaces;
  for (std::size_t i = 0; i < world.walls.size(); ++i) {
    const Wall& w = world.walls[i];
    require(finite({w.from.x_m, w.from.y_m, w.to.x_m, w.to.y_m}), "wall", i, "a coordinate is not finite");
    surfaces.push_back(with_material(segment(w.from, w.to), w.material, "wall", i));
  }
  for (std::size_t i = 0; i < world.boxes.size(); ++i) {
    const Box& box = world.boxes[i];
    require(finite({box.centre.x_m, box.centre.y_m, box.length_m, box.width_m, box.yaw_rad}), "box", i,
            "a number is not finite");
    require(box.length_m >= 0 && box.width_m >= 0, "box", i, "length_m or width_m is negative");
    const double c = std::cos(box.yaw_rad), s = std::sin(box.yaw_rad);
    const double l = box.length_m / 2, w = box.width_m / 2;
    const auto corner = [&](double x, double y) {
      return Point{box.centre.x_m + c * x - s * y, box.centre.y_m + s * x + c * y};
    };
    const Point corners[4] = {corner(-l, -w), corner(l, -w), corner(l, w), corner(-l, w)};
    for (int k = 0; k < 4; ++k)
      surfaces.push_back(with_material(segment(corners[k], corners[(k + 1) % 4]), box.material, "box", i));
  }
  for (std::size_t i = 0; i < world.circles.size(); ++i) {
    const Circle& circle = world.circles[i];
    require(finite({circle.centre.x_m, circle.centre.y_m, circle.radius_m}), "circle", i, "a number is not finite");
    require(circle.radius_m >= 0, "circle", i, "radius_m is negative");
    Surface s{
        .kind = Surface::Kind::circle, .a = {circle.centre.x_m, circle.centre.y_m}, .b = {}, .radius = circle.radius_m};
    surfaces.push_back(with_material(s, circle.material, "circle", i));
  }
  for (std::size_t i = 0; i < world.polygons.size(); ++i) {
    const std::vector<Point>& v = world.polygons[i].vertices;
    require(v.size() >= 2, "polygon", i, "has fewer than two vertices");
    for (const Point& p : v) require(finite({p.x_m, p.y_m}), "polygon", i, "a coordinate is not finite");
    for (std::size_t k = 0; k < v.size(); ++k)
      surfaces.push_back(with_material(segment(v[k], v[(k + 1) % v.size()]), world.polygons[i].material, "polygon", i));
  }
  return surfaces;
}

}  // namespace evigrid::raycast
