// SPDX-License-Identifier: Apache-2.0
// One surface and one cone, apex at the origin: the nearest point of the surface in the cone, the part of it that gives
// an echo (its incidence is within the critical one and its absorption lets it be heard from there), and where a ray
// meets it. No other surface is looked at here.
#pragma once
#include <optional>

#include "surface.hpp"
#include "vec2.hpp"

namespace evigrid::raycast {

/// Directions from `right` counter-clockwise to `left`, both included; spans less than π.
struct Arc {
  Vec2 right, left;
};

/// Rounding of a cross product of two directions.
inline constexpr double kRounding = 1e-15;
inline bool contains(const Arc& arc, Vec2 u) {
  return cross(arc.right, u) >= -kRounding && cross(u, arc.left) >= -kRounding && dot(u, arc.right + arc.left) >= 0;
}
std::optional<Arc> intersection(const Arc& a, const Arc& b);
/// Cross product of the two ends: the sine of the span.
inline double sine_of_span(const Arc& arc) { return cross(arc.right, arc.left); }

/// The closed cone, its edges moved outwards by kEdgeSlack_rad.
struct Wedge {
  Vec2 axis;
  Arc arc;
};
/// Cosine and sine of half the opening, with the slack: the cones of a ring share them.
struct HalfOpening {
  explicit HalfOpening(double aperture_rad);
  double aperture_rad, cosine, sine;
};
Wedge make_wedge(double yaw_rad, const HalfOpening& half);
inline Wedge make_wedge(double yaw_rad, double aperture_rad) { return make_wedge(yaw_rad, HalfOpening(aperture_rad)); }

/// Nearest point in the wedge whatever the incidence; contact with the apex is the point (0, 0).
std::optional<Vec2> nearest_in_wedge(const Surface& s, const Wedge& wedge);

/// Whether the surface at its point `p`, seen from the origin, is met within its critical incidence.
bool within_critical(const Surface& s, Vec2 p);

/// Whether the surface at its point `p` gives an echo that a sensor of this range hears at the origin.
bool gives_echo(const Surface& s, Vec2 p, double max_range_m);

/// A connected part of a surface inside the wedge that gives an echo, as directions, and its nearest point.
struct Piece {
  Arc arc;
  Vec2 nearest;
};
/// None or one, but for a circle around the origin: two by incidence, each parted in two where it is too far to hear.
struct Pieces {
  Piece piece[4];
  int count = 0;
};
Pieces echo_pieces(const Surface& s, const Wedge& wedge, double max_range_m);

/// A surface as rays from the origin meet it, with what does not depend on the ray worked out once, and only when
/// asked.
class Met {
 public:
  explicit Met(const Surface& s);
  /// Distance at which the ray meets it first; +∞ when it misses. Hides kHidingSlack_rad beyond the ends.
  [[nodiscard]] double distance(Vec2 direction);

 private:
  Surface::Kind kind_;
  Vec2 a_;  ///< as the surface has it; of a circle, its centre
  Vec2 right_, left_, edge_;
  double to_right_ = 0, to_left_ = 0, area_ = 0, height_ = 0;
  double edge_on_ = -1;  ///< < 0: this and height_ are not known yet
  double radius_ = 0, centre_m_ = 0;
};
inline double hit_distance(const Surface& s, Vec2 direction) { return Met(s).distance(direction); }

}  // namespace evigrid::raycast
