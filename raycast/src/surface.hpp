// SPDX-License-Identifier: Apache-2.0
// The two kinds of surface that everything is made of: a straight segment and a circle, each with its critical
// incidence and its absorption. Boxes and polygons are taken apart here, and bad worlds are refused here.
#pragma once
#include <vector>

#include "evigrid/raycast/world.hpp"
#include "tolerance.hpp"
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
  double absorption = 0;
  double heard_share = 1;  ///< √(1 − absorption): this share of a sensor's range it is heard from
};

/// Farthest echo of this surface that a sensor with this range hears, closed.
inline double heard_m(const Surface& s, double max_range_m) { return max_range_m * s.heard_share + kContact_m; }

/// Throws std::invalid_argument naming the object, e.g. "box 2: width_m is negative".
std::vector<Surface> take_apart(const World& world);

/// The same surface seen from `origin`.
inline Surface seen_from(Surface s, Vec2 origin) {
  s.a = s.a - origin;
  s.b = s.b - origin;
  return s;
}

}  // namespace evigrid::raycast
