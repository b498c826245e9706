// SPDX-License-Identifier: Apache-2.0
// The cheap question before the exact one: whether a surface surely has nothing in a wedge within a limit. No division
// and no root; in doubt it says no, and nearest_in_wedge (wedge.hpp) decides. Most surfaces that an index proposes end
// here.
#pragma once
#include <algorithm>
#include <cmath>

#include "surface.hpp"
#include "vec2.hpp"
#include "wedge.hpp"

namespace evigrid::raycast {

/// `s`: seen from the apex. True only when nearest_in_wedge gives no point, or one farther than `limit_m`.
inline bool surely_outside(const Surface& s, const Wedge& w, double limit_m) {
  const Vec2 right = w.arc.right, left = w.arc.left, a = s.a;
  if (s.kind == Surface::Kind::circle) {
    // Contact counts wherever it is, and products round: the margin is far above both.
    const double reach = s.radius + 2 * kContact_m + 1e-12 * (std::abs(a.x) + std::abs(a.y) + s.radius);
    const double farthest = limit_m + reach;
    return cross(right, a) < -reach || cross(a, left) < -reach || dot(w.axis, a) < -reach ||
           dot(a, a) > farthest * farthest;
  }
  const Vec2 b = s.b, edge = b - a;
  const double margin = 2 * kContact_m + 1e-12 * (std::abs(a.x) + std::abs(a.y) + std::abs(b.x) + std::abs(b.y));
  if (std::max(cross(right, a), cross(right, b)) < -margin || std::max(cross(a, left), cross(b, left)) < -margin ||
      std::max(dot(w.axis, a), dot(w.axis, b)) < -margin)
    return true;
  // The whole line is farther away.
  const double area = cross(a, edge), farthest = limit_m + margin;
  return area * area > farthest * farthest * dot(edge, edge) * (1 + 1e-12);
}

}  // namespace evigrid::raycast
