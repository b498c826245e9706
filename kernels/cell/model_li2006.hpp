// SPDX-License-Identifier: Apache-2.0
// li2006 (Li, Huang & Dezert 2006, chapter 14, eq. 14.6–14.10; d, R in metres):
//   (14.6) m(empty) = 1 − (d/R)², d ≤ R            (14.7) m(occupied) = exp(−3ρv(d − R)²), d ≤ R + ε
//   (14.8) m(both) = 1 − (2(d − R + 2ε)/R)², d ≤ R (14.9) m(unknown) = tanh 2(d − R) from R on
// Repaired: all four are printed with the factor λ (14.10), which dividing by their sum would cancel; we divide first
// and then discount by λ (`discount_by_lambda = false` takes the print). (14.8) falls below 0 for d < R/2 − 2ε: taken
// as 0. Behind R + ε only (14.9) is left, which divided by itself is vacuous. Everything is multiplied by 1 + e^(−4(d −
// R)), so that the tanh costs no division.
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/cell/polar.hpp"
#include "kernels/cell/poly.hpp"

EVIGRID_CELL_BEGIN

struct ModelLi2006 {
  template <class V>
  static EVIGRID_FN FaintSource<V> measure(const ConeReading& q, const Polar<V>& p) {
    const auto& k = q.li2006;
    const V zero(0.0f), one(1.0f), least(-80.0f);
    const V d = root(p.d2), d2 = nonzero(p.d2), to_range = d + V(k.range), inverse = one / (d2 * to_range);
    const V by_d2 = to_range * inverse, skew = p.nl - p.nr;
    const V margin = (p.nl * p.nr) * by_d2;
    const V lambda = mul_add(margin, cubic(k.lambda, margin), V(k.rest));
    const V off = (skew * skew) * by_d2, doubt = off * cubic(k.off_axis, off);  // 1 − λ, right relatively on the axis
    // d − R, one Newton step from the rounded difference: (14.7) falls steeply, and under Dempster's rule its ratio to
    // the other masses counts, not its size. The rate is two floats for the same reason.
    const V rough = d - V(k.range);
    const V dr = mul_add(neg_mul_add(rough, rough + V(k.range_twice), p.edge), d2 * inverse, rough);
    // Not 1 − 2^y: near the axis all of m(unknown) is 1 − λ, and an ulp of 1 would be many of it.
    const auto f = exponential(max_of(zero - max_of(dr, zero) * V(k.unknown_rate), least));
    const V times = one + f.value;
    const V x = times * max_of(zero - p.edge * V(k.range_inverse_square), zero);
    const V dr2 = dr * dr;
    const V far_tail =
        exp2_poly(max_of(neg_mul_add(dr2, V(k.occupied_rate), zero - dr2 * V(k.occupied_rate_rest)), least));
    const V y = times * settle_source(far_tail);
    const V g = mul_add(dr, V(k.both_slope), V(k.both_offset));
    const V z = times * select(p.edge <= zero, max_of(neg_mul_add(g, g, one), zero), zero);
    const V v = zero - f.less_one;
    const V sum = x + y, s = (sum + z) + v;
    return {settle_source(x * lambda), settle_source(y * lambda), mul_add(v, lambda, s * doubt), z * lambda, s,
            z / nonzero(sum)};
  }
};

EVIGRID_CELL_END
