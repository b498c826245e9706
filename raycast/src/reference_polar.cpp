// SPDX-License-Identifier: Apache-2.0
#include "reference_polar.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tolerance.hpp"

namespace evigrid::raycast::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Polar segment(const Surface& s, double axis_rad) {
  const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y, size = std::hypot(dx, dy);
  const double to_a = std::hypot(s.a.x, s.a.y), to_b = std::hypot(s.b.x, s.b.y);
  const double angle_a = wrapped(std::atan2(s.a.y, s.a.x) - axis_rad);
  const double angle_b = wrapped(std::atan2(s.b.y, s.b.x) - axis_rad);
  const double turn = wrapped(angle_b - angle_a);
  Polar p;
  p.begin_rad = turn >= 0 ? angle_a : angle_b;
  p.span_rad = std::abs(turn);
  p.nearer_end_m = std::min(to_a, to_b);
  p.farther_end_m = std::max(to_a, to_b);
  p.critical_rad = s.critical_incidence_rad;
  p.absorption = s.absorption;
  p.point = size <= kContact_m;
  if (p.point) {
    p.towards_rad = angle_a;
    p.distance_m = to_a;
    p.contact = to_a <= kContact_m;
    return p;
  }
  const double signed_height = (s.a.x * dy - s.a.y * dx) / size;  // normal (dy, −dx)/size points at the foot if > 0
  const double side = signed_height < 0 ? -1 : 1;
  p.towards_rad = wrapped(std::atan2(-side * dx, side * dy) - axis_rad);
  p.distance_m = std::abs(signed_height);
  const double along = -(s.a.x * dx + s.a.y * dy) / size;
  p.contact = std::min(to_a, to_b) <= kContact_m || (p.distance_m <= kContact_m && along >= 0 && along <= size);
  return p;
}

}  // namespace

double wrapped(double angle_rad) { return std::remainder(angle_rad, 2 * kPi); }

Polar polar(const Surface& s, double axis_rad) {
  if (s.kind == Surface::Kind::segment) return segment(s, axis_rad);
  Polar p;
  p.round = true;
  p.towards_rad = wrapped(std::atan2(s.a.y, s.a.x) - axis_rad);
  p.distance_m = std::hypot(s.a.x, s.a.y);
  p.radius_m = s.radius;
  p.critical_rad = s.critical_incidence_rad;
  p.absorption = s.absorption;
  p.contact = std::abs(p.distance_m - p.radius_m) <= kContact_m;
  return p;
}

double range_at(const Polar& p, double angle_rad) {
  const double off = wrapped(angle_rad - p.towards_rad);
  if (p.round) {
    const double sine = p.distance_m * std::sin(off);
    const double half_chord = std::sqrt(std::max(0.0, p.radius_m * p.radius_m - sine * sine));
    if (p.inside()) return p.distance_m * std::cos(off) + half_chord;
    if (std::abs(off) > std::asin(std::min(1.0, p.radius_m / p.distance_m)) + kHidingSlack_rad) return kInfinity;
    return p.distance_m * std::cos(off) - half_chord;
  }
  const double after_begin = wrapped(angle_rad - p.begin_rad - p.span_rad / 2) + p.span_rad / 2;
  if (after_begin < -kHidingSlack_rad || after_begin > p.span_rad + kHidingSlack_rad) return kInfinity;
  if (p.edge_on()) return p.nearer_end_m;
  const double cosine = std::cos(off);
  return cosine > 0 ? std::min(p.distance_m / cosine, p.farther_end_m) : p.farther_end_m;
}

bool reaches(const Polar& p, double angle_rad) {
  if (p.round || p.edge_on()) return true;
  const double after_begin = wrapped(angle_rad - p.begin_rad - p.span_rad / 2) + p.span_rad / 2;
  return after_begin >= -kEventRounding_rad && after_begin <= p.span_rad + kEventRounding_rad;
}

bool echoes(const Polar& p, double angle_rad) {
  if (p.point || p.critical_rad + kEdgeSlack_rad >= kPi / 2) return true;
  const double off = std::abs(wrapped(angle_rad - p.towards_rad));
  if (!p.round) return off <= p.critical_rad + kEdgeSlack_rad;
  const double sine = p.radius_m > 0 ? std::min(1.0, p.distance_m * std::sin(off) / p.radius_m) : 0;
  return std::asin(sine) <= p.critical_rad + kEdgeSlack_rad;
}

bool audible(const Polar& p, double range_m, double max_range_m) {
  if (range_m <= kContact_m) return true;
  const double counted_m = range_m - kContact_m;  // closed
  return (1 - p.absorption) * (max_range_m * max_range_m) >= counted_m * counted_m;
}

std::vector<double> turning_points(const Polar& p) {
  if (p.round) {
    const double side = p.inside() ? kPi : std::asin(p.radius_m / p.distance_m);
    return {p.towards_rad - side, p.towards_rad, p.towards_rad + side};
  }
  const double begin = p.begin_rad, foot = begin + wrapped(p.towards_rad - begin), end = begin + p.span_rad;
  if (foot > begin && foot < end) return {begin, foot, end};
  return {begin, end};
}

double least_m(const Polar& p) {
  if (p.round) return p.inside() ? p.radius_m - p.distance_m : p.distance_m - p.radius_m;
  return std::min(p.distance_m, p.nearer_end_m);
}
double most_m(const Polar& p) { return p.round ? p.distance_m + p.radius_m : p.farther_end_m; }

}  // namespace evigrid::raycast::reference
