// SPDX-License-Identifier: Apache-2.0
// fuzzy (Li, Huang & Dezert 2006, eq. 14.15–14.16): memberships Ψ of empty = x and Ω of occupied = y, the parts of
// oriolo1997 with ε for Δ. Repaired: the printed fΩ is kO before the arc, where the cell should be empty, and
// kO((R − d)/ε)² on it, least where the echo is; we take Oriolo's fO. `as_printed` takes the print; its pieces end with
// a step at R + ε (left out, as printed), and Ψ + Ω may exceed 1: memberships may.
#pragma once
#include "kernels/cell/tanh_cone.hpp"

EVIGRID_CELL_BEGIN

struct ModelFuzzy {
  template <class V>
  static EVIGRID_FN PlainSource<V> measure(const ConeReading& q, const Polar<V>& p) {
    const auto& k = q.tanh;
    const V zero(0.0f), one(1.0f);
    const auto c = tanh_cone(k, p);
    const V before = min_of(max_of(zero - c.t, zero), one);
    const V x = settle_source(c.share * (V(k.k_empty) * (before * before)));
    const V shape =
        k.as_printed ? select(p.outer < zero, min_of(c.t * c.t, one), zero) : max_of((one + c.t) * c.rest, zero);
    const V y = settle_source(c.share * (V(k.k_occupied) * shape));
    return {x, y, max_of(one - (x + y), zero)};
  }
};

EVIGRID_CELL_END
