// SPDX-License-Identifier: Apache-2.0
// li2014 (Li, Huang, Wang, Dezert 2014, eq. 8–13), unnormalised and divided by exp(−d²/(2(RρE)²)), so that two
// exponentials are left and the tanh of the thin ignorance shell becomes a fitted cubic. λ is computed from the margins
// to both edges (no subtraction: it must be right relatively near the edge), d − R with one Newton step (the shell is
// steep).
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/cell/polar.hpp"
#include "kernels/cell/poly.hpp"

EVIGRID_CELL_BEGIN

struct ModelLi2014 {
  template <class V>
  static EVIGRID_FN Source<V> measure(const ConeReading& q, const Polar<V>& p) {
    const auto& k = q.li;
    const V zero(0.0f), one(1.0f);
    const V d = root(p.d2);
    const V margin = (p.nl * p.nr) / nonzero(p.d2);  // sin²α − sin²θ
    const V lambda = margin * cubic(k.lambda, margin);
    // log2 of what everything is divided by; rates are two floats: their rounding would add up over like readings
    const V h = mul_add(p.d2, V(k.empty_rate), p.d2 * V(k.empty_rate_rest));
    V dr = d - V(k.range);
    dr = mul_add(neg_mul_add(dr, dr + V(k.range_twice), p.edge), V(k.range_twice_inverse), dr);
    // Equation (8) empty, (9) occupied, (10) paradox, (11) unknown
    const V x = neg_mul_add(V(0.5f), lambda, one);
    const V dr2 = dr * dr;
    const V yo = neg_mul_add(dr2, V(k.occupied_rate), neg_mul_add(dr2, V(k.occupied_rate_rest), h));
    const V far_tail = lambda * exp2_poly(max_of(yo, V(-80.0f)));
    const V y = select(far_tail >= V(1e-20f), far_tail, zero);  // so that no product with a cell becomes denormal
    const V t = max_of(min_of(mul_add(dr, V(k.peak_inverse), V(k.peak_offset)), V(0.516f)), V(-0.463f));  // d/e^β − 1.1
    const V l = scaled_log(t) * V(k.paradox_scale);
    const V z = exp2_poly(neg_mul_add(l, l, h));
    const V into = max_of(mul_add(dr, V(k.shell_slope), V(k.shell_offset)), zero);
    const V v = max_of(one - lambda, zero) * (into * cubic(k.shell, into));
    return {x, y, v, z, ((x + y) + z) + v};
  }
};

EVIGRID_CELL_END
