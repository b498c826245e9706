// SPDX-License-Identifier: Apache-2.0
// oriolo1997 (Oriolo, Ulivi & Vendittelli 1997, as masses by Asharif et al. 2001): m(empty) = γρ·fE,
// m(occupied) = γρ·fO,
//   fE = kE for d < R − Δ, kE((R − d)/Δ)² on [R − Δ, R), 0 beyond,
//   fO = kO[1 − ((d − R)/Δ)²] on [R − Δ, R + Δ), 0 elsewhere.
// fE + fO ≤ max(kE, kO) ≤ 1 everywhere, so there is nothing to clamp. All pieces meet continuously: no exact border but
// the far end.
#pragma once
#include "kernels/cell/tanh_cone.hpp"

EVIGRID_CELL_BEGIN

struct ModelOriolo1997 {
  template <class V>
  static EVIGRID_FN PlainSource<V> measure(const ConeReading& q, const Polar<V>& p) {
    const auto& k = q.tanh;
    const V zero(0.0f), one(1.0f);
    const auto c = tanh_cone(k, p);
    const V before = min_of(max_of(zero - c.t, zero), one);
    const V x = settle_source(c.share * (V(k.k_empty) * (before * before)));
    const V y = settle_source(c.share * (V(k.k_occupied) * max_of((one + c.t) * c.rest, zero)));
    return {x, y, max_of(one - (x + y), zero)};
  }
};

EVIGRID_CELL_END
