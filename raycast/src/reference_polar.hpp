// SPDX-License-Identifier: Apache-2.0
// A surface as the reference sees it: in angles around the sensor. For each angle: how far, whether it is there, and
// whether it gives an echo. Shares no formula with the caster.
#pragma once
#include <vector>

#include "surface.hpp"

namespace evigrid::raycast::reference {

/// A part of a surface narrower than this is one ray: it is looked at by itself.
inline constexpr double kOneRay_rad = 1e-8;
/// Events nearer together than this are the same one.
inline constexpr double kEventRounding_rad = 1e-11;

/// Into [-π, π].
double wrapped(double angle_rad);

/// A surface in polar terms around the sensor, angles relative to the axis of the cone.
struct Polar {
  bool round = false;
  double towards_rad = 0;   ///< foot of the perpendicular, or centre
  double distance_m = 0;    ///< of the line, or of the centre
  double radius_m = 0;      ///< circle
  double begin_rad = 0;     ///< segment: first end, and from there counter-clockwise
  double span_rad = 0;      ///< to the other end, < π
  double nearer_end_m = 0;  ///< segment
  double farther_end_m = 0;
  double critical_rad = 0;
  double absorption = 0;
  bool point = false;    ///< no direction of its own: echoes to every side
  bool contact = false;  ///< the sensor stands on it
  [[nodiscard]] bool inside() const { return round && distance_m < radius_m; }
  [[nodiscard]] bool edge_on() const { return !round && span_rad < kOneRay_rad; }
};

/// `s` seen from the sensor; angles relative to `axis_rad`.
Polar polar(const Surface& s, double axis_rad);

/// Distance along the ray at this angle; +∞ when it misses.
double range_at(const Polar& p, double angle_rad);

/// Whether the surface itself is there, without the slack by which it hides: its end is not a place to be seen.
bool reaches(const Polar& p, double angle_rad);

/// Whether the incidence at this angle is within the critical one.
bool echoes(const Polar& p, double angle_rad);

/// Whether an echo from this far still has the energy of a perfect one from max_range_m.
bool audible(const Polar& p, double range_m, double max_range_m);

/// Angles between which the range grows or shrinks all the way: ends, tangents, foot or centre; not wrapped.
std::vector<double> turning_points(const Polar& p);

/// Nearest and farthest point of the whole surface, as bounds.
double least_m(const Polar& p);
double most_m(const Polar& p);

}  // namespace evigrid::raycast::reference
