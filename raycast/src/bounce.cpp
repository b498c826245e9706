// SPDX-License-Identifier: Apache-2.0
// Second bounces, the false reflections of Li et al. (2014). Sound that meets surface 1 beyond its critical incidence
// is thrown away as by a mirror. If it then meets surface 2 within the critical incidence of that one, it is sent back
// the way it came, over surface 1 again, into the cone it left: it has gone d1 + d2 out and d2 + d1 back, and the
// sonar, which halves the whole way, reads d1 + d2 in the direction of surface 1: too long. A way out over both and
// straight back from surface 2 is shorter, but then surface 2 is seen directly and its direct echo is heard before.
//
// Loss: both surfaces absorb, the mirror twice, and the energy falls with the square of the unfolded way, so that the
// echo is heard when d1 + d2 <= max_range · (1 − a1) · √(1 − a2). Approximations: sound is rays (no diffraction at
// edges, a curved mirror does not spread them), a mirror is perfect, ways of more bounces are not followed, and the
// shortest way is the shortest among the sampled directions: never shorter than the true one, and longer by about the
// square of their distance, or by the distance itself where the shortest way lies at an edge.
#include <algorithm>
#include <bit>
#include <vector>

#include "query.hpp"
#include "sampled.hpp"
#include "wedge.hpp"

namespace evigrid::raycast {
namespace {

/// The rays of a packet after a mirror: those that went on, and what they have behind them.
struct Reflected {
  Rays rays;
  SurfaceName mirror[kPacket];
  double before_m[kPacket], share[kPacket];
  Lanes lanes = 0;
};

Reflected reflect(const Caster& caster, const Rays& rays, const Hits& hits, Lanes met, Placements placements) {
  Reflected r;
  r.rays = rays;
  for (Lanes rest = met; rest != 0; rest &= rest - 1) {
    const int k = std::countr_zero(rest);
    const Vec2 from = rays.origin(k), u = rays.direction(k), point = hits.first_m[k] * u;
    const Surface s = caster.seen(hits.first[k], from, placements);
    if (within_critical(s, point)) continue;  // an echo of its own, not a mirror
    const Vec2 n = normal_at(s, point);
    r.rays.set(k, from + point, u - 2 * dot(u, n) * n);
    r.mirror[k] = hits.first[k];
    r.before_m[k] = hits.first_m[k];
    r.share[k] = s.heard_share * s.heard_share;
    r.lanes |= Lanes{1} << k;
  }
  r.rays.one_origin = r.rays.narrow = false;
  return r;
}

}  // namespace

Echo Scene::cast_cone_second_bounce(const ConeQuery& q, Placements movers, int rays) const {
  check_samples(rays);
  const Echo direct = cast_cone(q, movers);
  double best_m = std::min(direct.range_m, q.max_range_m + kContact_m);
  bool bounced = false;
  // No way is longer than that, so neither of its parts leaves this circle.
  const std::vector<Standing> near = impl_->around({q.x_m, q.y_m}, best_m, nullptr, movers);
  const auto follow = [&](const Rays& out, const Hits& hits, Lanes met) {
    Reflected r = reflect(*impl_, out, hits, met, movers);
    if (r.lanes == 0) return;
    Hits second;
    second.clear(kPacket, 0, q.max_range_m);
    for (Lanes rest = r.lanes; rest != 0; rest &= rest - 1) {
      const int k = std::countr_zero(rest);
      second.first_m[k] = best_m - r.before_m[k];
    }
    for (int k = 0; k < kPacket; ++k)
      if ((r.lanes >> k & 1) == 0) r.mirror[k] = kNobody;
    r.rays.left_from = r.mirror;
    impl_->first_hits(r.rays, r.lanes, near, second);
    for (Lanes rest = r.lanes; rest != 0; rest &= rest - 1) {
      const int k = std::countr_zero(rest);
      if (second.first[k] == kNobody) continue;
      const Surface s = impl_->seen(second.first[k], r.rays.origin(k), movers);
      const double way_m = r.before_m[k] + second.first_m[k];
      if (way_m >= best_m || !within_critical(s, second.first_m[k] * r.rays.direction(k))) continue;
      if (way_m > heard_m(s, q.max_range_m * r.share[k])) continue;
      best_m = way_m;
      bounced = true;
    }
  };
  if (direct.range_m > 0)
    sample_cone(
        *impl_, q, rays, near, [&] { return best_m; }, follow);
  return bounced ? echo_at(best_m, q) : direct;
}

}  // namespace evigrid::raycast
