// SPDX-License-Identifier: Apache-2.0
// probability (Li, Huang & Dezert 2006, eq. 14.13): P(occupied) = (1 + λ'·g)/2 with λ' = γρ, a = (d − R)/ε and
//   g = −1 for a < −2, −(1 − (2 + a)²) on [−2, −1), 1 − a² on [−1, 1), 0 beyond.
// As a source the Bayesian mass (1 − P, P, 0): BetP and PlP agree on it. Continuous everywhere.
#pragma once
#include "kernels/cell/tanh_cone.hpp"

EVIGRID_CELL_BEGIN

struct ModelProbability {
  template <class V>
  static EVIGRID_FN ProbabilitySource<V> measure(const ConeReading& q, const Polar<V>& p) {
    const V zero(0.0f), one(1.0f), half(0.5f);
    const auto c = tanh_cone(q.tanh, p);
    const V after = one + c.t, b = max_of(one + after, zero);
    const V g = select(after < zero, mul_add(b, b, zero - one), after * c.rest);
    const V h = half * (c.share * g);
    return {half - h, half + h, zero, h + h};
  }
};

EVIGRID_CELL_END
