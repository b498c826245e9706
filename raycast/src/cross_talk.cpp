// SPDX-License-Identifier: Apache-2.0
// Cross-talk: two sonars ping at the same moment and one hears the sound of the other. It comes from the speaker to a
// surface point and on to the listener, d1 + d2, and the listener, which believes it is its own, reads (d1 + d2) / 2.
//
// Whether a surface sends sound from one to the other: an echo is given within the critical incidence of the surface,
// measured between its normal and the way back. With two sonars the half of both ways takes this place, as between
// light and eye in the facet model of Torrance and Sparrow (1967): both must be on the same side, and the bisector of
// the directions to them lies within the critical incidence of the normal. For one sonar in both roles this is the echo
// itself, and a perfect mirror sends sound where it must: to the mirrored direction. Absorption is as for echoes. The
// ping is as loud as its speaker's range says, and the listener stops listening at its own: the smaller one counts.
//
// Approximations: sound is rays; the direct way between two sonars that face each other is left out, as are more
// bounces; the way is the shortest among the sampled directions of the listener: never shorter than the true one.
#include <algorithm>
#include <bit>
#include <vector>

#include "query.hpp"
#include "sampled.hpp"
#include "wedge.hpp"

namespace evigrid::raycast {
namespace {

/// A point where the listener's sound might come from, and half the way there.
struct Source {
  double half_way_m;
  Vec2 from_speaker;
};

/// Whether the surface, seen from the listener, sends sound from `speaker` over its point `p` to the listener.
bool sends(const Surface& s, Vec2 p, Vec2 speaker) {
  const Vec2 n = normal_at(s, p), to_listener = -unit(p), to_speaker = unit(speaker - p);
  const double facing_listener = dot(n, to_listener), facing_speaker = dot(n, to_speaker);
  if (facing_listener * facing_speaker <= 0) return false;
  const Vec2 half = to_listener + to_speaker;
  return s.sin_critical >= 1 || std::abs(cross(n, half)) <= s.tan_critical * std::abs(dot(n, half));
}

}  // namespace

Echo Scene::cross_talk(const ConeQuery& speaker, const ConeQuery& listener, Placements movers, int rays) const {
  check(speaker);
  check(listener);
  check_samples(rays);
  impl_->check(movers);
  const Vec2 at_speaker{speaker.x_m, speaker.y_m}, at_listener{listener.x_m, listener.y_m};
  const Vec2 between = at_speaker - at_listener;
  const Wedge spoken = make_wedge(speaker.yaw_rad, speaker.aperture_rad);
  const double range_m = std::min(speaker.max_range_m, listener.max_range_m);
  // The point lies within both ways of the listener, and what hides it from the speaker lies between.
  const std::vector<Standing> near =
      impl_->around(at_listener, std::max(2 * range_m, length(between)), nullptr, movers);
  std::vector<Source> sources;
  const auto consider = [&](const Rays& out, const Hits& hits, Lanes met) {
    for (Lanes rest = met; rest != 0; rest &= rest - 1) {
      const int k = std::countr_zero(rest);
      const Vec2 p = hits.first_m[k] * out.direction(k), from_speaker = p - between;
      const double spoken_m = length(from_speaker), half_way_m = (spoken_m + hits.first_m[k]) / 2;
      if (hits.first_m[k] <= kContact_m || spoken_m <= kContact_m) continue;  // it covers one of the two
      const Surface s = impl_->seen(hits.first[k], at_listener, movers);
      if (half_way_m <= heard_m(s, range_m) && contains(spoken.arc, unit(from_speaker)) && sends(s, p, between))
        sources.push_back({half_way_m, from_speaker});
    }
  };
  sample_cone(
      *impl_, listener, rays, near, [&] { return 2 * range_m; }, consider);
  std::stable_sort(sources.begin(), sources.end(),
                   [](const Source& l, const Source& r) { return l.half_way_m < r.half_way_m; });
  for (const Source& source : sources) {
    // Nothing before the point but the point itself.
    const double way_m = length(source.from_speaker), before_m = way_m - kContact_m * (1 + way_m);
    Rays ray;
    Hits hits;
    ray.one_origin = true;
    ray.set(0, at_speaker, unit(source.from_speaker));
    hits.clear(1, before_m, speaker.max_range_m);
    impl_->first_hits(ray, 1, near, hits);
    if (hits.first[0] == kNobody) return echo_at(source.half_way_m, listener);
  }
  return {};
}

}  // namespace evigrid::raycast
