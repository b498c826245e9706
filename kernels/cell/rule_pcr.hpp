// SPDX-License-Identifier: Apache-2.0
// Proportional conflict redistribution, two sources (Smarandache & Dezert 2005), and GERM-PCR2 (Li et al. 2014). The
// quotients are multiplied out, so that each rule costs one division; products of small masses are cut at 1e-16 before
// they could become denormal (the share they would have had is below 5e-9 of a mass).
#pragma once
#include "kernels/cell/mass.hpp"

EVIGRID_CELL_BEGIN

/// PCR2: k is shared out in proportion to the columns a+x and b+y. `conflict` is k, for GERM-PCR2 z + k.
template <class State, class V, class S>
EVIGRID_FN Combined<V> share_by_columns(const Cell<V>& c, const S& m, const Conjunctive<V>& q, const V& conflict) {
  const V as = c.a * scale(m) + m.x, bs = c.b * scale(m) + m.y;  // columns
  const V d = as + bs;
  const auto none = d <= V(kTiny);  // nothing to share by: the conflict goes to unknown
  // Without conflict nothing is shared and nothing needs the common denominator: a vacuous source then leaves a
  // normalised cell as it is, bit for bit.
  const V dd = select(both(d > V(kTiny), conflict > V(0.0f)), d, V(1.0f));
  const V e = q.e * dd + conflict * as, o = q.o * dd + conflict * bs;
  const V t = select(none, q.t + conflict, q.t);
  const V r = V(1.0f) / ((e + o) + t * dd);
  const V w = dd * r;
  return {settle<State>(Cell<V>{e * r, o * r, t * w}), conflict_of(m, conflict, w)};
}

struct Pcr2 {
  static constexpr Paradox kParadox = kGivenBack;
  static constexpr bool kTotalPossible = false;
  template <class State, class V, class S>
  static EVIGRID_FN Combined<V> combine(const Cell<V>& c, const S& source) {
    const S m = give_back(source);
    const Conjunctive<V> q = conjunctive(c, m);
    return share_by_columns<State>(c, m, q, q.k);
  }
};

struct GermPcr2 {
  static constexpr bool kTotalPossible = false;
  template <class State, class V, class S>
  static EVIGRID_FN Combined<V> combine(const Cell<V>& c, const S& m) {
    const Conjunctive<V> q = conjunctive(c, m);
    if constexpr (requires { m.z; }) {
      return share_by_columns<State>(c, m, q, q.k + m.z);
    } else {
      return share_by_columns<State>(c, m, q, q.k);
    }
  }
};

template <class V>
EVIGRID_FN V above(const V& product, const V& cut) {
  return select(product > cut, product, V(0.0f));
}

/// PCR5: each partial conflict a·y and b·x goes back to its own two parties in proportion to what each put in.
struct Pcr5 {
  static constexpr Paradox kParadox = kGivenBack;
  static constexpr bool kTotalPossible = false;
  template <class State, class V, class S>
  static EVIGRID_FN Combined<V> combine(const Cell<V>& c, const S& source) {
    if constexpr (kBothNormalised<State, S>) {
      return combine_in_map<State>(c, source);
    } else {
      return combine_at_large<State>(c, source);
    }
  }

  /// A normalised cell of a map and a normalised source without paradoxical mass: three divisions are cheaper than
  /// multiplying them out, and sums fused, so that the small products never stand alone.
  template <class State, class V>
  static EVIGRID_FN Combined<V> combine_in_map(const Cell<V>& c, const PlainSource<V>& m) {
    const Conjunctive<V> q = conjunctive_in_map(c, m);
    const V least(kLeastColumn);
    const V ay = c.a * m.y, bx = c.b * m.x;
    const V p = ay / max_of(c.a + m.y, least), w = bx / max_of(c.b + m.x, least);
    const V e = mul_add(p, c.a, mul_add(w, m.x, q.e)), o = mul_add(p, m.y, mul_add(w, c.b, q.o));
    const V r = V(1.0f) / ((e + o) + q.t);
    return {settle<State>(Cell<V>{e * r, o * r, q.t * r}), ay + bx};
  }
  /// Below any column that holds a mass: those are 0 or above 1e-12.
  static constexpr float kLeastColumn = 1e-30f;

  template <class State, class V, class S>
  static EVIGRID_FN Combined<V> combine_at_large(const Cell<V>& c, const S& source) {
    const V zero(0.0f), cut(State::kFloors ? 1e-16f : 0.0f);
    const S m = give_back(source);
    const Conjunctive<V> q = conjunctive(c, m);
    const V as = c.a * scale(m), bs = c.b * scale(m);
    const V d1 = nonzero(as + m.y), d2 = nonzero(bs + m.x);
    // p/(d1·d2) = a·y/(a + y)
    const auto p = above(c.a * m.y, cut) * d2;  // of a one-sided source one of them is zero by type
    const auto w = above(c.b * m.x, cut) * d1;
    const V dd = select(q.k > zero, d1 * d2, V(1.0f));  // without conflict no common denominator: see above
    const V e = q.e * dd + (p * as + w * m.x), o = q.o * dd + (p * m.y + w * bs);
    const V r = V(1.0f) / ((e + o) + q.t * dd);
    const V n = dd * r;
    return {settle<State>(Cell<V>{e * r, o * r, q.t * n}), conflict_of(m, q.k, n)};
  }
};

EVIGRID_CELL_END
