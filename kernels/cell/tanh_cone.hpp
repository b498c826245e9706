// SPDX-License-Identifier: Apache-2.0
// What oriolo1997, fuzzy and probability share (Oriolo et al. 1997; Li, Huang & Dezert 2006, eq. 14.11–14.12): the
// place in the arc t = (d − R)/Δ, and how far the reading is believed there, γ(θ)·ρ(d). γ = 1 − θ²/2 (θ in radians) =
// 1 − α²(1 − λ)/2; ρ = ½(1 − tanh 2(d − ρv)) = 1/(1 + e^4(d − ρv)), metres. Repaired: γ ends at the cone's own edge,
// not at 12.5° for every cone; where ρ is below 2.1e-9 (d > ρv + 5 m) the reading says nothing. d − R and the distance
// to the far end come from the exact rings (no difference of rounded distances); one division does for all quotients.
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/cell/polar.hpp"
#include "kernels/cell/poly.hpp"

EVIGRID_CELL_BEGIN

template <class V>
struct TanhCone {
  V t, rest, share;  // (d − R)/Δ; 1 − t, right relatively where it ends; γ·ρ
};

template <class V>
EVIGRID_FN TanhCone<V> tanh_cone(const TanhConstants& k, const Polar<V>& p) {
  const V zero(0.0f), one(1.0f);
  const V d = root(p.d2), d2 = nonzero(p.d2);
  const V w = one + exp2_poly(max_of(min_of(mul_add(d, V(k.decay), V(k.decay_offset)), V(30.0f)), V(-80.0f)));
  const V to_range = d + V(k.range), to_reach = d + V(k.reach);
  const V a = to_range * to_reach, b = d2 * w, inverse = one / (a * b);
  const V by_a = b * inverse;  // 1/a
  const V margin = (p.nl * p.nr) * (a * (w * inverse));
  const V lambda = margin * cubic(k.lambda, margin);
  const V gamma = mul_add(lambda, V(k.gamma_slope), V(k.gamma));
  return {(p.edge * V(k.width_inverse)) * (to_reach * by_a),
          ((zero - p.outer) * (to_range * by_a) + V(k.gap)) * V(k.width_inverse), gamma * (a * (d2 * inverse))};
}

EVIGRID_CELL_END
