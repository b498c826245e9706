// SPDX-License-Identifier: Apache-2.0
#include "wedge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "segment.hpp"
#include "tolerance.hpp"

namespace evigrid::raycast {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool touches_origin(const Surface& s) {
  return s.kind == Surface::Kind::circle ? std::abs(length(s.a) - s.radius) <= kContact_m
                                         : segment_touches_origin(s.a, s.b - s.a);
}

Vec2 clamped(const Arc& arc, Vec2 u) {
  if (contains(arc, u)) return u;
  return dot(u, arc.right) > dot(u, arc.left) ? arc.right : arc.left;
}

/// Directions within ±β of `centre`.
Arc around(Vec2 centre, double sine) {
  const double cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
  return {rotated(centre, cosine, -sine), rotated(centre, cosine, sine)};
}

/// Nearest point of a circle over an arc of directions that all meet it.
Vec2 nearest_on_circle(const Surface& s, const Arc& arc) {
  const auto at = [&](Vec2 u) { return hit_distance(s, u) * u; };
  const double centre_distance = length(s.a);
  if (centre_distance > s.radius) return at(clamped(arc, unit(s.a)));
  Vec2 best = at(arc.right);
  const auto consider = [&](Vec2 p) {
    if (dot(p, p) < dot(best, best)) best = p;
  };
  consider(at(arc.left));
  if (centre_distance > 0 && contains(arc, -unit(s.a))) consider(at(-unit(s.a)));
  return best;
}

/// An angle by its cosine and sine, in [0, π].
struct Angle {
  double cosine, sine;
};

/// Angle between the centre of a circle and its point at distance `h`, |D − r| <= h <= D + r: law of cosines, in a form
/// that keeps small angles exact: sin²(θ/2) = (r² − (D − h)²) / 4Dh.
Angle angle_at(const Surface& s, double distance, double h) {
  const double square =
      std::clamp((s.radius - distance + h) * (s.radius + distance - h) / (4 * distance * h), 0.0, 1.0);
  return {1 - 2 * square, 2 * std::sqrt(square * (1 - square))};
}

struct Arcs {
  Arc arc[2];
  int count = 0;
};

/// Directions in which a circle around the origin is no farther than `heard`: all but those too near to its centre's.
/// Each arc spans less than π.
Arcs heard_around(const Surface& s, double distance, double heard) {
  const Vec2 back = -unit(s.a);
  const Angle off = angle_at(s, distance, heard);
  if (off.cosine < 0) return {{around(back, off.sine), {}}, 1};
  return {{{rotated(-back, off.cosine, off.sine), back}, {back, rotated(-back, off.cosine, -off.sine)}}, 2};
}

/// Parts of a circle met at no more than `sin_limit`, sin(incidence) = D·sin(angle to the centre) / r, and no farther
/// away than `heard`.
Pieces circle_pieces(const Surface& s, const Wedge& w, double sin_limit, double heard) {
  Pieces pieces;
  const double distance = length(s.a);
  if (heard < std::abs(distance - s.radius)) return pieces;
  const auto add = [&](const std::optional<Arc>& arc) {
    if (arc) pieces.piece[pieces.count++] = {*arc, nearest_on_circle(s, *arc)};
  };
  if (distance > s.radius) {
    double sine = s.radius * sin_limit / distance;
    if (heard * heard < distance * distance - s.radius * s.radius)
      sine = std::min(sine, angle_at(s, distance, heard).sine);
    add(intersection(around(unit(s.a), sine), w.arc));
    return pieces;
  }
  const bool everywhere = heard >= distance + s.radius;
  const Arcs near = everywhere ? Arcs{{w.arc, {}}, 1} : heard_around(s, distance, heard);
  for (int i = 0; i < near.count; ++i) {
    const auto seen = everywhere ? std::optional(w.arc) : intersection(near.arc[i], w.arc);
    if (!seen) continue;
    if (s.radius * sin_limit >= distance) {
      add(seen);
      continue;
    }
    const double sine = s.radius * sin_limit / distance;
    add(intersection(around(unit(s.a), sine), *seen));
    add(intersection(around(-unit(s.a), sine), *seen));
  }
  return pieces;
}

Piece point_piece(Vec2 p) { return {{unit(p), unit(p)}, p}; }

}  // namespace

std::optional<Arc> intersection(const Arc& a, const Arc& b) {
  Arc common;
  if (contains(b, a.right))
    common.right = a.right;
  else if (contains(a, b.right))
    common.right = b.right;
  else
    return std::nullopt;
  if (contains(b, a.left))
    common.left = a.left;
  else if (contains(a, b.left))
    common.left = b.left;
  else
    return std::nullopt;
  return common;
}

HalfOpening::HalfOpening(double opening_rad) : aperture_rad(opening_rad) {
  const double half = opening_rad / 2 + kEdgeSlack_rad;
  cosine = std::cos(half), sine = std::sin(half);
}

Wedge make_wedge(double yaw_rad, const HalfOpening& half) {
  const Vec2 axis{std::cos(yaw_rad), std::sin(yaw_rad)};
  return {axis, {rotated(axis, half.cosine, -half.sine), rotated(axis, half.cosine, half.sine)}};
}

std::optional<Vec2> nearest_in_wedge(const Surface& s, const Wedge& w) {
  if (s.kind == Surface::Kind::segment) return nearest_of_segment(s.a, s.b, w);
  if (touches_origin(s)) return Vec2{0, 0};
  const Pieces whole = circle_pieces(s, w, 1, kInfinity);
  std::optional<Vec2> best;
  for (int i = 0; i < whole.count; ++i) {
    const Vec2 p = whole.piece[i].nearest;
    if (!best || dot(p, p) < dot(*best, *best)) best = p;
  }
  return best;
}

bool within_critical(const Surface& s, Vec2 p) {
  const double range = length(p);
  if (range <= kContact_m || s.tan_critical == kInfinity) return true;
  if (s.kind == Surface::Kind::circle) return std::abs(cross(p, s.a)) <= s.radius * s.sin_critical * range;
  const Vec2 edge = s.b - s.a;
  if (is_point(edge)) return true;
  return std::abs(dot(p, edge)) <= s.tan_critical * std::abs(cross(p, edge));
}

bool gives_echo(const Surface& s, Vec2 p, double max_range_m) {
  return length(p) <= heard_m(s, max_range_m) && within_critical(s, p);
}

Pieces echo_pieces(const Surface& s, const Wedge& w, double max_range_m) {
  // What absorbs nothing is heard from wherever the cone reaches.
  const double heard = s.heard_share < 1 ? heard_m(s, max_range_m) : kInfinity;
  if (s.kind == Surface::Kind::circle) return circle_pieces(s, w, s.sin_critical, heard);
  Pieces none, one;
  one.count = 1;
  const Vec2 edge = s.b - s.a;
  if (is_point(edge)) {
    one.piece[0] = point_piece(s.a);
    return contains(w.arc, unit(s.a)) && length(s.a) <= heard ? one : none;
  }
  Range r = clip(s.a, edge, w);
  const Foot f = foot(s.a, edge);
  const auto keep_around_foot = [&](double reach) {
    r.low = std::max(r.low, f.u - reach);
    r.high = std::min(r.high, f.u + reach);
  };
  if (s.tan_critical != kInfinity) keep_around_foot(f.height * s.tan_critical / length(edge));
  if (f.height > heard) return none;
  if (heard < kInfinity) keep_around_foot(std::sqrt((heard - f.height) * (heard + f.height)) / length(edge));
  if (r.empty()) return none;
  const auto at = [&](double u) { return s.a + u * edge; };
  Arc arc{unit(at(r.low)), unit(at(r.high))};
  if (cross(arc.right, arc.left) < 0) std::swap(arc.right, arc.left);
  one.piece[0] = {arc, at(std::clamp(f.u, r.low, r.high))};
  return one;
}

Met::Met(const Surface& s) : kind_(s.kind), a_(s.a), radius_(s.radius) {
  if (s.kind == Surface::Kind::circle) {
    centre_m_ = length(s.a);
    return;
  }
  const bool swap = cross(s.a, s.b) < 0;
  right_ = swap ? s.b : s.a, left_ = swap ? s.a : s.b, edge_ = left_ - right_;
  to_right_ = length(right_), to_left_ = length(left_);
}

double Met::distance(Vec2 u) {
  const double slack = kHidingSlack_rad;
  if (kind_ == Surface::Kind::circle) {
    const double along = dot(u, a_), across = cross(u, a_);
    const double half_chord = std::sqrt(std::max(0.0, radius_ * radius_ - across * across));
    if (centre_m_ <= radius_) return along + half_chord;
    if (along <= 0 || std::abs(across) > radius_ + slack * centre_m_) return kInfinity;
    return along - half_chord;
  }
  if (cross(right_, u) < -slack * to_right_ || cross(u, left_) < -slack * to_left_) return kInfinity;
  if (dot(u, right_) <= 0 && dot(u, left_) <= 0) return kInfinity;
  if (edge_on_ < 0) {
    edge_on_ = kEdgeOn * length(edge_);
    height_ = foot(a_, edge_).height;
    area_ = cross(right_, edge_);
  }
  const double facing = cross(u, edge_);
  if (facing <= edge_on_) return std::min(to_right_, to_left_);  // seen edge-on, or a point
  return std::max(height_, std::min(area_ / facing, std::max(to_right_, to_left_)));
}

}  // namespace evigrid::raycast
