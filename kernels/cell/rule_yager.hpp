// SPDX-License-Identifier: Apache-2.0
// Rules that turn conflict into ignorance. Yager (1987): all of it to the unknown. On this frame and under Shafer's
// model Dubois & Prade (1988) and DSmH (Dezert & Smarandache 2004) say the same, until a source holds mass on
// empty ∩ occupied: DSmH then takes each product by the union of what made it, the other two drop that mass.
#pragma once
#include "kernels/cell/mass.hpp"

EVIGRID_CELL_BEGIN

/// The conjunctive part with the conflict moved to the unknown, divided by its own sum.
template <class State, class V, class S>
EVIGRID_FN Combined<V> to_unknown(const S& m, const V& e, const V& o, const V& t, const V& conflict) {
  const V r = V(1.0f) / ((e + o) + t);
  return {settle<State>(Cell<V>{e * r, o * r, t * r}), conflict_of(m, conflict, r)};
}

struct Yager {
  static constexpr Paradox kParadox = kDropped;
  static constexpr bool kTotalPossible = false;
  template <class State, class V, class S>
  static EVIGRID_FN Combined<V> combine(const Cell<V>& c, const S& source) {
    const S m = drop_paradox(source);
    const Conjunctive<V> q = conjunctive(c, m);
    return to_unknown<State>(m, q.e, q.o, q.t + q.k, q.k);
  }
};

struct Dsmh {
  static constexpr bool kTotalPossible = false;
  template <class State, class V, class S>
  static EVIGRID_FN Combined<V> combine(const Cell<V>& c, const S& m) {
    const Conjunctive<V> q = conjunctive(c, m);
    if constexpr (requires { m.z; }) {
      return to_unknown<State>(m, q.e + c.a * m.z, q.o + c.b * m.z, (q.t + c.u * m.z) + q.k, q.k + m.z);
    } else {
      return to_unknown<State>(m, q.e, q.o, q.t + q.k, q.k);
    }
  }
};

EVIGRID_CELL_END
