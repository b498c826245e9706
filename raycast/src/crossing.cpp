// SPDX-License-Identifier: Apache-2.0
#include "crossing.hpp"

#include <cmath>
#include <utility>

namespace evigrid::raycast {
namespace {

/// Ends are taken a little longer than they are: a crossing too many is one more candidate, a missing one is an error.
constexpr double kOverlap = 1e-9;

bool within(double u) { return u >= -kOverlap && u <= 1 + kOverlap; }

Crossings segments(const Surface& s, const Surface& t) {
  const Vec2 e = s.b - s.a, f = t.b - t.a, offset = t.a - s.a;
  const double area = cross(e, f);
  if (std::abs(area) <= 1e-14 * length(e) * length(f)) return {};
  const double u = cross(offset, f) / area, v = cross(offset, e) / area;
  if (!within(u) || !within(v)) return {};
  return {{s.a + u * e, {}}, 1};
}

Crossings segment_circle(const Surface& s, const Surface& circle) {
  const Vec2 e = s.b - s.a, offset = circle.a - s.a;
  const double square = dot(e, e);
  if (square == 0) return {};
  const double middle = dot(offset, e) / square, distance = cross(e, offset) / std::sqrt(square);
  const double rest = circle.radius * circle.radius - distance * distance;
  if (rest < 0) return {};
  Crossings found;
  const double half_chord = std::sqrt(rest / square);
  for (double u : {middle - half_chord, middle + half_chord})
    if (within(u)) found.point[found.count++] = s.a + u * e;
  return found;
}

Crossings circles(const Surface& s, const Surface& t) {
  const Vec2 between = t.a - s.a;
  const double distance = length(between);
  if (distance == 0) return {};
  const double along = (distance * distance + s.radius * s.radius - t.radius * t.radius) / (2 * distance);
  const double rest = s.radius * s.radius - along * along;
  if (rest < 0) return {};
  const Vec2 axis = (1 / distance) * between, aside = std::sqrt(rest) * perpendicular(axis);
  const Vec2 foot = s.a + along * axis;
  return {{foot + aside, foot - aside}, 2};
}

}  // namespace

Crossings crossings_of(const Surface& s, const Surface& t) {
  const bool s_round = s.kind == Surface::Kind::circle, t_round = t.kind == Surface::Kind::circle;
  if (s_round && t_round) return circles(s, t);
  if (s_round) return segment_circle(t, s);
  if (t_round) return segment_circle(s, t);
  return segments(s, t);
}

}  // namespace evigrid::raycast
