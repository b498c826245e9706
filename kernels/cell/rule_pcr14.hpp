// SPDX-License-Identifier: Apache-2.0
// PCR1 and PCR4 (Smarandache & Dezert, Advances and Applications of DSmT for Information Fusion, vol. 2, 2006), two
// sources. PCR1 shares the conflict by all columns, that of the unknown too; PCR4 by the conjunctive masses e : o, and
// by the columns a+x : b+y where one of those is zero. PCR4 is discontinuous there. One division each (rule_pcr.hpp).
#pragma once
#include "kernels/cell/mass.hpp"

EVIGRID_CELL_BEGIN

struct Pcr1 {
  static constexpr Paradox kParadox = kGivenBack;
  static constexpr bool kTotalPossible = false;
  template <class State, class V, class S>
  static EVIGRID_FN Combined<V> combine(const Cell<V>& c, const S& source) {
    const S m = give_back(source);
    const Conjunctive<V> q = conjunctive(c, m);
    const V s = scale(m);
    const V as = c.a * s + m.x, bs = c.b * s + m.y, us = c.u * s + m.v;  // columns
    const V dd = select(q.k > V(0.0f), (as + bs) + us, V(1.0f));         // without conflict no common denominator
    const V e = q.e * dd + q.k * as, o = q.o * dd + q.k * bs, t = q.t * dd + q.k * us;
    const V r = V(1.0f) / ((e + o) + t);
    return {settle<State>(Cell<V>{e * r, o * r, t * r}), conflict_of(m, q.k, dd * r)};
  }
};

/// PCR4 asks whether e and o are zero. Exact operands: a source raised by a power of two answers even where the product
/// of two masses would be denormal.
template <class V>
EVIGRID_FN Source<V> raised(const PlainSource<V>& m) {
  const V up(std::is_same_v<V, double> ? 1.2676506e30f : 1.0995116e12f);  // 2^100, 2^40
  return {m.x * up, m.y * up, m.v * up, V(0.0f), up};
}

// No kParadox: it asks whether masses are zero, so even the smallest y of a model counts, everywhere.
struct Pcr4 {
  static constexpr bool kTotalPossible = false;
  template <class State, class V, class S>
  static EVIGRID_FN Combined<V> combine(const Cell<V>& c, const S& source) {
    if constexpr (State::kFloors) {
      return share<State>(c, give_back(source));
    } else {
      Combined<V> r = share<State>(c, raised(source));
      r.k = c.a * source.y + c.b * source.x;  // of operands whose sums are 1 up to rounding, as every rule's
      return r;
    }
  }
  template <class State, class V, class S>
  static EVIGRID_FN Combined<V> share(const Cell<V>& c, const S& m) {
    const Conjunctive<V> q = conjunctive(c, m);
    const V s = scale(m);
    const V as = c.a * s + m.x, bs = c.b * s + m.y;  // columns
    const V zero = V(State::kMassFloor) * s;         // what a map keeps as zero is zero here: no denormal decides
    const auto by_masses = both(q.e > zero, q.o > zero);
    const V x = select(by_masses, q.e, as), y = select(by_masses, q.o, bs);
    const V dd = select(q.k > V(0.0f), x + y, V(1.0f));  // without conflict no common denominator
    const V e = q.e * dd + q.k * x, o = q.o * dd + q.k * y;
    const V r = V(1.0f) / ((e + o) + q.t * dd);
    const V n = dd * r;
    return {settle<State>(Cell<V>{e * r, o * r, q.t * n}), conflict_of(m, q.k, n)};
  }
};

EVIGRID_CELL_END
