// SPDX-License-Identifier: Apache-2.0
// The two kinds of surface that everything is made of: a straight segment and a circle, each with its critical
// incidence. Boxes and polygons are taken apart here, and bad worlds are refused here.
#pragma once
#include <vector>

#include "evigrid/raycast/world.hpp"
#include "vec2.hpp"

namespace evigrid::raycast {

struct Surface {
  enum class Kind { segment, circle };
  Kind kind = Kind::segment;
  Vec2 a;             ///< segment: one end. circle: centre
  Vec2 b;             ///< segment: other end
  double radius = 0;  ///< circle
  double critical_incidence_rad = 0;
  double sin_critical = 1;  ///< of the critical incidence plus its slack
  double tan_critical = 0;  ///< same; +∞ when every incidence gives an echo
};

/// Throws std::invalid_argument naming the object, e.g. "box 2: width_m is negative".
std::vector<Surface> take_apart(const World& world);

/// The same surface seen from `origin`.
inline Surface seen_from(Surface s, Vec2 origin) {
  s.a = s.a - origin;
  s.b = s.b - origin;
  return s;
}

}  // namespace evigrid::raycast
