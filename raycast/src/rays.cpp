// SPDX-License-Identifier: Apache-2.0
// A packet from one origin is met two rays at a time (SSE2, which every x86-64 has): the same formulas as hit_distance
// (wedge.cpp), with what depends on the surface and the origin alone computed once. Any other ray goes one by one.
#include "rays.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "tolerance.hpp"
#include "wedge.hpp"

namespace evigrid::raycast {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Pair = __m128d;
Pair both(double v) { return _mm_set1_pd(v); }
Pair select(Pair mask, Pair yes, Pair no) { return _mm_or_pd(_mm_and_pd(mask, yes), _mm_andnot_pd(mask, no)); }
/// a·b + c·d and a·b − c·d.
Pair sum(Pair a, Pair b, Pair c, Pair d) { return _mm_add_pd(_mm_mul_pd(a, b), _mm_mul_pd(c, d)); }
Pair difference(Pair a, Pair b, Pair c, Pair d) { return _mm_sub_pd(_mm_mul_pd(a, b), _mm_mul_pd(c, d)); }

/// A straight surface seen from the common origin: which rays meet it, and then where.
class Straight {
 public:
  Straight(const Surface& s, Vec2 origin) {
    const Vec2 a = s.a - origin, b = s.b - origin;
    const bool swap = cross(a, b) < 0;
    right_ = swap ? b : a, left_ = swap ? a : b;
    // Both lengths by one root.
    const Pair x = _mm_set_pd(left_.x, right_.x), y = _mm_set_pd(left_.y, right_.y);
    lengths_ = _mm_sqrt_pd(sum(x, x, y, y));
    const Pair beyond = _mm_mul_pd(both(-kHidingSlack_rad), lengths_);
    right_x_ = both(right_.x), right_y_ = both(right_.y), left_x_ = both(left_.x), left_y_ = both(left_.y);
    beyond_right_ = _mm_unpacklo_pd(beyond, beyond), beyond_left_ = _mm_unpackhi_pd(beyond, beyond);
  }
  [[nodiscard]] Pair meets(Pair x, Pair y) const {
    const Pair ahead = _mm_max_pd(sum(x, right_x_, y, right_y_), sum(x, left_x_, y, left_y_));
    const Pair within = _mm_and_pd(_mm_cmpge_pd(difference(right_x_, y, right_y_, x), beyond_right_),
                                   _mm_cmpge_pd(difference(x, left_y_, y, left_x_), beyond_left_));
    return _mm_and_pd(within, _mm_cmpgt_pd(ahead, _mm_setzero_pd()));
  }

  class Range {
   public:
    explicit Range(const Straight& s) {
      const Vec2 edge = s.left_ - s.right_;
      const double size = length(edge), area = cross(s.right_, edge);
      const double to_right = _mm_cvtsd_f64(s.lengths_),
                   to_left = _mm_cvtsd_f64(_mm_unpackhi_pd(s.lengths_, s.lengths_));
      const double end = std::min(to_right, to_left);
      edge_x_ = both(edge.x), edge_y_ = both(edge.y), area_ = both(area), edge_on_ = both(kEdgeOn * size);
      nearer_end_ = both(end), farther_end_ = both(std::max(to_right, to_left));
      height_ = both(size > 0 ? std::abs(area) / size : end);
    }
    [[nodiscard]] Pair operator()(Pair x, Pair y) const {
      const Pair facing = difference(x, edge_y_, y, edge_x_);
      const Pair on_line = _mm_max_pd(height_, _mm_min_pd(_mm_div_pd(area_, facing), farther_end_));
      return select(_mm_cmpgt_pd(facing, edge_on_), on_line, nearer_end_);
    }

   private:
    Pair edge_x_, edge_y_, area_, edge_on_, nearer_end_, farther_end_, height_;
  };

 private:
  Vec2 right_, left_;
  Pair lengths_, right_x_, right_y_, left_x_, left_y_, beyond_right_, beyond_left_;
};

/// A circle seen from the common origin.
class Round {
 public:
  Round(const Surface& s, Vec2 origin) {
    const Vec2 centre = s.a - origin;
    const double distance = length(centre);
    inside_ = distance <= s.radius;
    centre_x_ = both(centre.x), centre_y_ = both(centre.y);
    square_ = both(s.radius * s.radius);
    reach_ = both(s.radius + kHidingSlack_rad * distance);
  }
  [[nodiscard]] Pair meets(Pair x, Pair y) const {
    if (inside_) return _mm_cmpeq_pd(reach_, reach_);
    const Pair along = sum(x, centre_x_, y, centre_y_), across = difference(x, centre_y_, y, centre_x_);
    const Pair beside = _mm_andnot_pd(both(-0.0), across);
    return _mm_and_pd(_mm_cmpgt_pd(along, _mm_setzero_pd()), _mm_cmple_pd(beside, reach_));
  }

  class Range {
   public:
    explicit Range(const Round& r) : round_(r) {}
    [[nodiscard]] Pair operator()(Pair x, Pair y) const {
      const Pair along = sum(x, round_.centre_x_, y, round_.centre_y_);
      const Pair across = difference(x, round_.centre_y_, y, round_.centre_x_);
      const Pair rest = _mm_max_pd(_mm_setzero_pd(), _mm_sub_pd(round_.square_, _mm_mul_pd(across, across)));
      const Pair half_chord = _mm_sqrt_pd(rest);
      return round_.inside_ ? _mm_add_pd(along, half_chord) : _mm_sub_pd(along, half_chord);
    }

   private:
    const Round& round_;
  };

 private:
  bool inside_;
  Pair centre_x_, centre_y_, square_, reach_;
};

double meet_one(const Surface& s, SurfaceName name, const Rays& rays, int k) {
  const Surface seen = seen_from(s, rays.origin(k));
  if (rays.left_from == nullptr || rays.left_from[k] != name) return hit_distance(seen, rays.direction(k));
  if (s.kind == Surface::Kind::segment) return kInfinity;
  const double chord = 2 * dot(rays.direction(k), seen.a);
  return chord > 0 ? chord : kInfinity;
}

/// Whether this hit replaces the one kept so far. At the same distance the smaller name wins, so that the answer does
/// not depend on who was proposed first.
bool nearer(double range_m, SurfaceName name, const Hits& hits, int k) {
  if (range_m == kInfinity) return false;
  return range_m < hits.first_m[k] || (range_m == hits.first_m[k] && name < hits.first[k]);
}

template <typename Shape>
Lanes meet_all(const Shape& shape, SurfaceName name, const Rays& rays, Lanes asked, double heard, Hits& hits) {
  const auto x_of = [&](int k) { return _mm_load_pd(rays.direction_x + k); };
  const auto y_of = [&](int k) { return _mm_load_pd(rays.direction_y + k); };
  Lanes met = 0;
  for (int k = 0; k < kPacket; k += 2) met |= static_cast<Lanes>(_mm_movemask_pd(shape.meets(x_of(k), y_of(k)))) << k;
  met &= asked;
  if (met == 0) return 0;

  alignas(16) static constexpr std::uint64_t kLanes[4][2] = {{0, 0}, {~0ull, 0}, {0, ~0ull}, {~0ull, ~0ull}};
  const typename Shape::Range range_of(shape);
  const __m128i who = _mm_set1_epi64x(static_cast<long long>(name));
  const Pair infinity = both(kInfinity), limit = both(heard);
  Lanes changed = 0;
  for (int k = 0; k < kPacket; k += 2) {
    const Lanes two = met >> k & 3;
    if (two == 0) continue;
    const Pair mine = _mm_castsi128_pd(_mm_load_si128(reinterpret_cast<const __m128i*>(kLanes[two])));
    const Pair range = select(mine, range_of(x_of(k), y_of(k)), infinity), first = _mm_load_pd(hits.first_m + k);
    const Pair audible = select(_mm_cmple_pd(range, limit), range, infinity);
    _mm_store_pd(hits.heard_m + k, _mm_min_pd(audible, _mm_load_pd(hits.heard_m + k)));
    const Pair less = _mm_cmplt_pd(range, first);
    auto* names = reinterpret_cast<__m128i*>(hits.first + k);
    const __m128i mask = _mm_castpd_si128(less);
    _mm_store_si128(names, _mm_or_si128(_mm_and_si128(mask, who), _mm_andnot_si128(mask, _mm_load_si128(names))));
    _mm_store_pd(hits.first_m + k, _mm_min_pd(range, first));
    changed |= static_cast<Lanes>(_mm_movemask_pd(less)) << k;
    // Equal ones are rare: the smaller name keeps the place.
    for (auto same = two & static_cast<Lanes>(_mm_movemask_pd(_mm_cmpeq_pd(range, first))); same != 0;
         same &= same - 1) {
      SurfaceName& kept = hits.first[k + std::countr_zero(same)];
      kept = std::min(kept, name);
    }
  }
  return changed;
}

/// Fewer rays than three are cheaper one by one.
bool worth_a_packet(Lanes asked) {
  const Lanes without_one = asked & (asked - 1);
  return (without_one & (without_one - 1)) != 0;
}

}  // namespace

Lanes meet(const Surface& s, SurfaceName name, const Rays& rays, Lanes asked, Hits& hits) {
  const double heard = heard_m(s, hits.max_range_m);
  if (rays.one_origin && rays.left_from == nullptr && worth_a_packet(asked)) {
    const Vec2 origin = rays.origin(0);
    return s.kind == Surface::Kind::segment ? meet_all(Straight(s, origin), name, rays, asked, heard, hits)
                                            : meet_all(Round(s, origin), name, rays, asked, heard, hits);
  }
  Lanes changed = 0;
  for (Lanes rest = asked; rest != 0; rest &= rest - 1) {
    const int k = std::countr_zero(rest);
    const double range = meet_one(s, name, rays, k);
    if (range <= heard) hits.heard_m[k] = std::min(hits.heard_m[k], range);
    if (!nearer(range, name, hits, k)) continue;
    hits.first_m[k] = range;
    hits.first[k] = name;
    changed |= Lanes{1} << k;
  }
  return changed;
}

}  // namespace evigrid::raycast
