// SPDX-License-Identifier: Apache-2.0
// What a range sensor can see: a flat world of vertical surfaces (extruded walls, boxes, round poles, polygons), in
// metres and radians of the map frame. It knows no grid and no mass. Circles are circles: they are never polygonised.
#pragma once
#include <numbers>
#include <vector>

#include "evigrid/raycast/export.hpp"

namespace evigrid {
namespace EVIGRID_RAYCAST_API raycast {

/// Acoustic property of a surface. Beyond the critical incidence (measured from the surface normal) sound is thrown
/// away from the sensor: that part of the surface gives no echo, but it still hides what is behind it.
///
/// Absorption: an echo from range R has energy (1 − absorption)/R² of a perfect one at 1 m and is heard when that is
/// not below the one of a perfect echo from max_range: the surface is heard (or seen by a laser) up to max_range·√(1 −
/// a). Farther away it gives no reading, but it still hides what is behind it. (ours: no paper gives a figure.)
struct Material {
  double critical_incidence_rad = std::numbers::pi / 2;  ///< in [0, π/2]; π/2: every part gives an echo
  double absorption = 0;                                 ///< in [0, 1): 0 reflects all energy
};

struct Point {
  double x_m = 0, y_m = 0;
};

/// A straight piece of wall without thickness. Of length 0 it is a post that echoes towards every side.
struct Wall {
  Point from{}, to{};
  Material material{};
};

/// A rectangle: `length_m` along its own x axis, which points to `yaw_rad`; only its outline is a surface.
struct Box {
  Point centre{};
  double length_m = 0, width_m = 0, yaw_rad = 0;
  Material material{};
};

struct Circle {
  Point centre{};
  double radius_m = 0;
  Material material{};
};

/// Closed outline: the last vertex is joined to the first. At least two vertices; it may be concave.
struct Polygon {
  std::vector<Point> vertices{};
  Material material{};
};

struct World {
  std::vector<Wall> walls{};
  std::vector<Box> boxes{};
  std::vector<Circle> circles{};
  std::vector<Polygon> polygons{};
};

/// Where a moving object stands at the moment of a ping: takes its own coordinates to map coordinates.
struct Placement {
  double x_m = 0, y_m = 0, yaw_rad = 0;
};

}  // namespace raycast
}  // namespace evigrid
