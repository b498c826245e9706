// SPDX-License-Identifier: Apache-2.0
// A moving object where it stands. Its surfaces stay in its own frame, with the index built once; a query goes there,
// and what it finds comes back turned. Coordinates are taken relative to the sensor before anything is turned, so that
// far from the origin nothing is lost.
#pragma once
#include <cmath>

#include "evigrid/raycast/world.hpp"
#include "surface.hpp"
#include "surface_index.hpp"

namespace evigrid::raycast {

/// Turns between map directions and those of one frame. The world itself is not turned.
struct Frame {
  Vec2 origin;
  double cosine = 1, sine = 0;
  bool turned = false;

  Frame() = default;
  explicit Frame(const Placement& p)
      : origin{p.x_m, p.y_m}, cosine(std::cos(p.yaw_rad)), sine(std::sin(p.yaw_rad)), turned(true) {}

  [[nodiscard]] Vec2 point_from_map(Vec2 p) const { return turned ? rotated(p - origin, cosine, -sine) : p; }
  [[nodiscard]] Vec2 direction_from_map(Vec2 u) const { return turned ? rotated(u, cosine, -sine) : u; }

  /// A surface of the frame as it is seen from `apex` (in the frame), with axes along those of the map.
  [[nodiscard]] Surface seen(const Surface& s, Vec2 apex) const {
    Surface t = seen_from(s, apex);
    if (!turned) return t;
    t.a = rotated(t.a, cosine, sine);
    t.b = rotated(t.b, cosine, sine);
    return t;
  }
};

/// A mover near enough to matter.
struct Standing {
  const SurfaceIndex* index;
  Frame frame;
};

}  // namespace evigrid::raycast
