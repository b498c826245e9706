// SPDX-License-Identifier: Apache-2.0
// Moving objects put into a world as ordinary shapes, for the reference; random ones; materials that absorb.
#pragma once
#include <vector>

#include "random_world.hpp"

namespace evigrid::raycast::testing {

inline Point placed(const Placement& at, Point p) {
  const double c = std::cos(at.yaw_rad), s = std::sin(at.yaw_rad);
  return {at.x_m + c * p.x_m - s * p.y_m, at.y_m + s * p.x_m + c * p.y_m};
}

/// `world` with `shape` standing there.
inline void put(World& world, const World& shape, const Placement& at) {
  for (Wall w : shape.walls) world.walls.push_back({placed(at, w.from), placed(at, w.to), w.material});
  for (Box b : shape.boxes)
    world.boxes.push_back({placed(at, b.centre), b.length_m, b.width_m, b.yaw_rad + at.yaw_rad, b.material});
  for (Circle c : shape.circles) world.circles.push_back({placed(at, c.centre), c.radius_m, c.material});
  for (Polygon p : shape.polygons) {
    for (Point& v : p.vertices) v = placed(at, v);
    world.polygons.push_back(p);
  }
}

inline World with(World world, const std::vector<World>& shapes, const std::vector<Placement>& at) {
  for (std::size_t i = 0; i < shapes.size(); ++i) put(world, shapes[i], at[i]);
  return world;
}

inline Placement random_placement(Random& r) { return {r.uniform(0, 8), r.uniform(0, 6), r.uniform(-7, 7)}; }

/// Robots: round, square, and one of many pieces (which gets a hierarchy of its own).
inline std::vector<World> random_movers(Random& r) {
  std::vector<World> shapes(5);
  shapes[0].circles.push_back({{0, 0}, r.uniform(0.1, 0.4), any_material(r)});
  shapes[1].boxes.push_back({{0.1, 0}, r.uniform(0.2, 0.8), r.uniform(0.2, 0.5), r.uniform(-1, 1), any_material(r)});
  shapes[1].circles.push_back({{0.3, 0.2}, 0.05, any_material(r)});
  shapes[2].walls.push_back({{-0.5, 0}, {0.5, 0.1}, any_material(r)});
  shapes[3].polygons.push_back({{}, any_material(r)});
  for (int i = 0; i < 12; ++i)
    shapes[3].polygons[0].vertices.push_back(
        {(i % 2 ? 0.4 : 0.25) * std::cos(i * kDegree * 30), (i % 2 ? 0.4 : 0.25) * std::sin(i * kDegree * 30)});
  return shapes;  // the last one is empty
}

/// Half of the shapes get an absorption.
inline void make_absorbing(World& w, Random& r) {
  const auto change = [&](Material& m) {
    if (r.below(2)) m.absorption = r.uniform(0, 0.99);
  };
  for (Wall& x : w.walls) change(x.material);
  for (Box& x : w.boxes) change(x.material);
  for (Circle& x : w.circles) change(x.material);
  for (Polygon& x : w.polygons) change(x.material);
}

}  // namespace evigrid::raycast::testing
