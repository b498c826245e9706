// SPDX-License-Identifier: Apache-2.0
// moravec1985 (Moravec & Elfes 1985): memberships x = λ·E of empty and y = λ·O/N of occupied,
//   E = 1 − ((d − Rmin)/(R − ε − Rmin))² on [Rmin, R − ε], O = 1 − ((d − R)/ε)² on [R − ε, R + ε].
// The rule takes x and y by algebraic sums, y cancelled by what the cell knows of empty: O' = O(1 − Emp). Ours: the
// paper divides O' by its sum over all cells of the reading; we divide O by N, the same sum without cancellation as an
// integral over the arc (never below 1), known before any cell is looked at, so that no tile waits for another.
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/cell/polar.hpp"
#include "kernels/cell/poly.hpp"

EVIGRID_CELL_BEGIN

struct ModelMoravec1985 {
  template <class V>
  static EVIGRID_FN YieldingSource<V> measure(const ConeReading& q, const Polar<V>& p) {
    const auto& k = q.moravec;
    const V zero(0.0f), one(1.0f), two(2.0f);
    const V d = root(p.d2), d2 = nonzero(p.d2);
    const V to_border = nonzero(d + V(k.border)), to_reach = nonzero(d + V(k.reach));
    const V a = to_border * to_reach, inverse = one / (a * d2), by_a = d2 * inverse;
    const V margin = (p.nl * p.nr) * (a * inverse);
    const V lambda = margin * cubic(k.lambda, margin);
    const V beyond = mul_add(p.edge, to_reach * by_a, V(k.border_shift));  // d − (R − ε)
    const V left = (zero - p.outer) * (to_border * by_a);                  // R + ε − d
    const V inward = max_of(zero - beyond * V(k.depth_inverse), zero);
    const V x = settle_source(lambda * max_of(inward * (two - inward), zero));
    const V y = settle_source(lambda * (max_of(beyond, zero) * (max_of(left, zero) * V(k.occupied))));
    return {x, y, max_of(one - (x + y), zero)};
  }
};

EVIGRID_CELL_END
