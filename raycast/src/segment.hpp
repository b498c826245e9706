// SPDX-License-Identifier: Apache-2.0
// A straight surface a + u·edge, u ∈ [0, 1], seen from the origin: its part in a wedge and its nearest point. A cone is
// answered by one or two of these, so what surely changes nothing is not divided.
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include "tolerance.hpp"
#include "vec2.hpp"
#include "wedge.hpp"

namespace evigrid::raycast {

/// Part [low, high] of a segment.
struct Range {
  double low = 0, high = 1;
  [[nodiscard]] bool empty() const { return low > high; }
};

/// Keeps the u with f0 + u·df >= 0. A quotient outside (0, 1) is not worth its division.
inline void keep_non_negative(Range& r, double f0, double df) {
  if (df > 0) {
    if (f0 < 0) r.low = std::max(r.low, -f0 / df);
  } else if (df < 0) {
    if (f0 < -df) r.high = std::min(r.high, -f0 / df);
  } else if (f0 < 0) {
    r.high = -1;
  }
}

inline Range clip(Vec2 a, Vec2 edge, const Wedge& w) {
  Range r;
  keep_non_negative(r, cross(w.arc.right, a), cross(w.arc.right, edge));
  keep_non_negative(r, cross(a, w.arc.left), cross(edge, w.arc.left));
  keep_non_negative(r, dot(w.axis, a), dot(w.axis, edge));  // a cone of opening 0 is not a line
  return r;
}

/// Parameter of the foot of the perpendicular, and the distance of the line.
struct Foot {
  double u, height;
};
inline Foot foot(Vec2 a, Vec2 edge) {
  const double square = dot(edge, edge);
  return {-dot(a, edge) / square, std::abs(cross(a, edge)) / std::sqrt(square)};
}

inline bool segment_touches_origin(Vec2 a, Vec2 edge) {
  const double square = dot(edge, edge), area = cross(a, edge);
  if (area * area > 16 * kContact_m * kContact_m * square) return false;  // its line passes by
  const double u = square > 0 ? std::clamp(-dot(a, edge) / square, 0.0, 1.0) : 0;
  return length(a + u * edge) <= kContact_m;
}

inline bool is_point(Vec2 edge) { return length(edge) <= kContact_m; }

inline std::optional<Vec2> nearest_of_segment(Vec2 a, Vec2 b, const Wedge& w) {
  const Vec2 edge = b - a;
  if (segment_touches_origin(a, edge)) return Vec2{0, 0};
  if (is_point(edge)) return contains(w.arc, unit(a)) ? std::optional(a) : std::nullopt;
  const Range r = clip(a, edge, w);
  if (r.empty()) return std::nullopt;
  return a + std::clamp(foot(a, edge).u, r.low, r.high) * edge;
}

}  // namespace evigrid::raycast
