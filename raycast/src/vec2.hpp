// SPDX-License-Identifier: Apache-2.0
// Plane vectors in double. A "direction" is a unit vector; the caster compares directions by cross products, without
// angles, so it needs no atan2 and has no seam at ±π.
#pragma once
#include <cmath>

namespace evigrid::raycast {

struct Vec2 {
  double x = 0, y = 0;
};

inline Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
inline Vec2 operator*(double k, Vec2 a) { return {k * a.x, k * a.y}; }
inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// > 0 when b lies counter-clockwise of a.
inline double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double length(Vec2 a) { return std::sqrt(dot(a, a)); }
/// Counter-clockwise by 90°.
inline Vec2 perpendicular(Vec2 a) { return {-a.y, a.x}; }
inline Vec2 unit(Vec2 a) { return (1 / length(a)) * a; }
/// Rotation by an angle given as (cos, sin).
inline Vec2 rotated(Vec2 a, double cosine, double sine) { return cosine * a + sine * perpendicular(a); }
/// Rotation of a direction by an angle so small that its sine is the angle.
inline Vec2 nudged(Vec2 u, double small_rad) { return u + small_rad * perpendicular(u); }

}  // namespace evigrid::raycast
