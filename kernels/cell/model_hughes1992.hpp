// SPDX-License-Identifier: Apache-2.0
// hughes1992 (Hughes & Murphy 1992): f = ½[(Rmax − d)/Rmax + (β − |θ|)/β]; m(empty) = f before the arc, m(occupied) =
// f·Max_occupied on it. The paper gives the arc no width: `tolerance_m` is ours.
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/cell/polar.hpp"
#include "kernels/cell/poly.hpp"

EVIGRID_CELL_BEGIN

struct ModelHughes1992 {
  static constexpr bool kTellsByZone = true, kHasFreeZone = false;
  template <class V>
  static EVIGRID_FN V confidence(const ConeReading& q, const Polar<V>& p) {
    const V zero(0.0f), one(1.0f);
    const V d = root(p.d2);
    const V sine = min_of(p.nl, p.nr) / d;                         // sine of the angle to the nearer edge, β − |θ|
    const V angular = sine * cubic(q.hughes.margin, sine * sine);  // (β − |θ|)/(2β)
    return max_of(min_of(mul_add(d, V(q.hughes.slope), V(0.5f)) + angular, one), zero);
  }
  template <class V>
  static EVIGRID_FN PlainSource<V> measure(const ConeReading& q, const Polar<V>& p) {
    const V f = confidence(q, p), zero(0.0f);
    const auto on_arc = p.edge >= zero;
    const V x = select(on_arc, zero, f), y = select(on_arc, f * V(q.hughes.max_occupied), zero);
    return {x, y, V(1.0f) - (x + y)};
  }

  /// Discounted; within `within_radius` no cell is on the arc.
  template <Paradox, bool kRim, class V>
  static EVIGRID_FN PlainSource<V> told(const ConeReading& q, const Polar<V>& p) {
    const V rho(q.reliability), doubt(q.doubt), zero(0.0f);
    if constexpr (kRim) {
      return discount(measure(q, p), rho, doubt);
    } else {
      const V f = confidence(q, p);
      return discount(PlainSource<V>{f, zero, V(1.0f) - f}, rho, doubt);
    }
  }
};

EVIGRID_CELL_END
