// SPDX-License-Identifier: Apache-2.0
// What second bounces and cross-talk share: a cone as a fan of rays, edges included, and how sound leaves a surface.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>

#include "caster.hpp"
#include "evigrid/raycast/cone.hpp"
#include "rays.hpp"
#include "surface.hpp"

namespace evigrid::raycast {

inline void check_samples(int rays) {
  if (rays < 1) throw std::invalid_argument("rays: at least one is needed");
}

/// Direction of the i-th of `count` rays, from the right edge of the cone to the left one; a single one is the axis.
inline Vec2 sample_direction(const ConeQuery& q, std::ptrdiff_t i, int count) {
  const double share = count > 1 ? static_cast<double>(i) / (count - 1) - 0.5 : 0;
  const double angle = q.yaw_rad + share * q.aperture_rad;
  return {std::cos(angle), std::sin(angle)};
}

/// Casts all rays of the cone in packets and tells take(rays, hits, lanes) what each packet met within limit_m().
template <typename Limit, typename Take>
void sample_cone(const Caster& caster, const ConeQuery& q, int count, std::span<const Standing> near,
                 const Limit& limit_m, const Take& take) {
  Rays rays;
  Hits hits;
  rays.one_origin = rays.narrow = true;
  for (std::ptrdiff_t begin = 0; begin < count; begin += kPacket) {
    const int lanes = static_cast<int>(std::min<std::ptrdiff_t>(kPacket, count - begin));
    for (int k = 0; k < kPacket; ++k)
      rays.set(k, {q.x_m, q.y_m}, sample_direction(q, begin + std::min(k, lanes - 1), count));
    hits.clear(kPacket, limit_m(), q.max_range_m);
    caster.first_hits(rays, first_lanes(lanes), near, hits);
    Lanes met = 0;
    for (int k = 0; k < lanes; ++k)
      if (hits.first[k] != kNobody) met |= Lanes{1} << k;
    take(rays, hits, met);
  }
}

/// Unit normal of a surface seen from a point, at its point `p` (from there too). A post or a circle of no size has
/// none of its own: it faces who looks at it.
inline Vec2 normal_at(const Surface& s, Vec2 p) {
  const bool round = s.kind == Surface::Kind::circle;
  const Vec2 n = round ? p - s.a : perpendicular(s.b - s.a);
  return (round ? s.radius : length(n)) > kContact_m ? unit(n) : -unit(p);
}

}  // namespace evigrid::raycast
