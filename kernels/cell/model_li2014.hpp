// SPDX-License-Identifier: Apache-2.0
// li2014 (Li, Huang, Wang, Dezert 2014, eq. 8–13), unnormalised and divided by exp(−d²/(2(RρE)²)), so that two
// exponentials are left and the tanh of the thin ignorance shell becomes a fitted cubic. λ is computed from the margins
// to both edges (no subtraction: it must be right relatively near the edge), d − R with one Newton step from d² − R²
// (roundings of d would add up in log-odds), and with one more from its exact value in the shell, which is steep.
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/cell/polar.hpp"
#include "kernels/cell/poly.hpp"

EVIGRID_CELL_BEGIN

struct ModelLi2014 {
  static constexpr bool kTellsByZone = true, kHasFreeZone = true, kAsksExcess = true;
  /// Equations (8) empty and (9) occupied. Below `least` y is exactly 0.
  template <class V>
  struct Main {
    V x, y, lambda, h, dr;
  };
  template <class V>
  static EVIGRID_FN Main<V> main_masses(const ConeReading& q, const Polar<V>& p, float least) {
    const auto& k = q.li;
    const V zero(0.0f), one(1.0f);
    const V rough = root(p.d2) - V(k.range);
    const V dr = mul_add(neg_mul_add(rough, rough + V(k.range_twice), p.excess), V(k.range_twice_inverse), rough);
    const V margin = (p.nl * p.nr) / p.d2;  // sin²α − sin²θ
    const V lambda = margin * cubic(k.lambda, margin);
    // log2 of what everything is divided by; rates are two floats: their rounding would add up over like readings
    const V h = mul_add(p.d2, V(k.empty_rate), p.d2 * V(k.empty_rate_rest));
    const V dr2 = dr * dr;
    const V yo = neg_mul_add(dr2, V(k.occupied_rate), neg_mul_add(dr2, V(k.occupied_rate_rest), h));
    const V tail = lambda * exp2_poly(max_of(yo, V(-80.0f)));
    const V y = select(tail >= V(least), tail, zero);  // so that no product with a cell becomes denormal
    return {neg_mul_add(V(0.5f), lambda, one), y, lambda, h, dr};
  }
  /// Equation (10) paradox.
  template <class V>
  static EVIGRID_FN V paradox(const ConeReading& q, const Main<V>& m) {
    const auto& k = q.li;
    const V t =
        max_of(min_of(mul_add(m.dr, V(k.peak_inverse), V(k.peak_offset)), V(0.516f)), V(-0.463f));  // d/e^β − 1.1
    const V l = scaled_log(t) * V(k.paradox_scale);
    return exp2_poly(neg_mul_add(l, l, m.h));
  }
  /// Equation (11) unknown; exactly 0 within `within_radius`.
  template <class V>
  static EVIGRID_FN V unknown(const ConeReading& q, const Polar<V>& p, const Main<V>& m) {
    const auto& k = q.li;
    const V zero(0.0f), one(1.0f);
    const V dr = mul_add(neg_mul_add(m.dr, m.dr + V(k.range_twice), p.edge), V(k.range_twice_inverse), m.dr);
    const V into = max_of(mul_add(dr, V(k.shell_slope), V(k.shell_offset)), zero);
    return max_of(one - m.lambda, zero) * (into * cubic(k.shell, into));
  }

  template <class V>
  static EVIGRID_FN Source<V> measure(const ConeReading& q, const Polar<V>& p) {
    const Main<V> m = main_masses(q, p, 1e-20f);
    const V z = paradox(q, m), v = unknown(q, p, m);
    return {m.x, m.y, v, z, ((m.x + m.y) + z) + v};
  }

  /// Normalised and discounted, for rules that give the paradoxical mass back to x and y in proportion or drop it.
  /// Given back, it counts in the shell only: as long as v = 0, what is left is x and y over their sum. The discount
  /// comes first, so what is dropped counts everywhere; and Dempster's rule can make much of a very small y.
  template <Paradox kParadox, bool kRim, class V>
  static EVIGRID_FN PlainSource<V> told(const ConeReading& q, const Polar<V>& p) {
    static_assert(kParadox != kConsumed);
    const V rho(q.reliability), doubt(q.doubt), one(1.0f);
    if constexpr (kParadox == kGivenBack) {
      const Main<V> m = main_masses(q, p, 1e-9f);  // none within `free_radius`
      const V xy = m.x + m.y;
      const V y = m.y * (rho / xy), x = rho - y;
      if constexpr (!kRim) return {x, y, doubt};
      const V known = xy + paradox(q, m);
      const V share = known / (known + unknown(q, p, m));  // exactly 1 where v = 0
      return {x * share, y * share, mul_add(rho, one - share, doubt)};
    } else {
      const Main<V> m = main_masses(q, p, 1e-20f);
      V v(0.0f);
      if constexpr (kRim) v = unknown(q, p, m);
      const V s = ((m.x + m.y) + paradox(q, m)) + v;
      const V x = m.x * rho, y = m.y * rho, rest = mul_add(v, rho, s * doubt);
      const V r = one / ((x + y) + rest);
      return {x * r, y * r, rest * r};
    }
  }
  /// Within `free_radius`: the same bits as `told` there.
  template <class V>
  static EVIGRID_FN PlainSource<V> told_free(const ConeReading& q) {
    return {V(q.reliability), V(0.0f), V(q.doubt)};
  }
};

EVIGRID_CELL_END
