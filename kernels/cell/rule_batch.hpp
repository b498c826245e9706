// SPDX-License-Identifier: Apache-2.0
// Rules of the batch call that no map can use: what they leave is no mass on (empty, occupied, unknown) alone, or is
// vacuous for a vacuous cell. Exact operands without mass on empty ∩ occupied; each symmetric in its operands and
// mirrored bit for bit. Sources by the rule.
#pragma once
#include "kernels/cell/mass.hpp"

EVIGRID_CELL_BEGIN

/// As Combined, with the mass on empty ∩ occupied (m(∅) in the open world).
template <class V>
struct CombinedOpen {
  Cell<V> cell;
  V k, c;
};

template <class V>
EVIGRID_FN V conflict_between(const Cell<V>& c, const PlainSource<V>& m) {
  return c.a * m.y + c.b * m.x;
}
template <class V>
EVIGRID_FN Cell<V> over_sum(const V& e, const V& o, const V& t) {
  const V r = V(1.0f) / ((e + o) + t);
  return {e * r, o * r, t * r};
}

/// Smets's conjunctive rule of the open world (1990), and DSmC, the classic rule of the free DSm model (Dezert &
/// Smarandache 2004): the conflict stays where it arose.
struct ConjunctiveRule {
  static constexpr bool kTotalPossible = false;
  template <class State, class V>
  static EVIGRID_FN CombinedOpen<V> combine(const Cell<V>& c, const PlainSource<V>& m) {
    const Conjunctive<V> q = conjunctive(c, m);
    const V r = V(1.0f) / ((q.e + q.o) + (q.t + q.k));
    return {{q.e * r, q.o * r, q.t * r}, q.k, q.k * r};
  }
};

/// Dubois & Prade (1986), disjunctive: each product to the union of what made it; one of the two sources is right.
struct Disjunctive {
  static constexpr bool kTotalPossible = false;
  template <class State, class V>
  static EVIGRID_FN Combined<V> combine(const Cell<V>& c, const PlainSource<V>& m) {
    const V k = conflict_between(c, m);
    const V mixed = (c.a * m.v + c.u * m.x) + (c.b * m.v + c.u * m.y);
    return {over_sum(c.a * m.x, c.b * m.y, (k + mixed) + c.u * m.v), k};
  }
};

/// Murphy (2000), two sources: their mean, once with itself by Dempster's rule. Four times the masses; their sum is
/// at least 2, so no total conflict and no denormal that counts.
struct Murphy {
  static constexpr bool kTotalPossible = false;
  template <class State, class V>
  static EVIGRID_FN Combined<V> combine(const Cell<V>& c, const PlainSource<V>& m) {
    const V a = c.a + m.x, b = c.b + m.y, u = c.u + m.v, uu = u + u;
    return {over_sum(a * (a + uu), b * (b + uu), u * u), conflict_between(c, m)};
  }
};

/// Denœux's cautious rule (2008), normalised: the larger weight of each hypothesis, l1 = ln(1 + x/v), of the two
/// sources. With x/v for the weights this is e : o : u = max(a/u, x/v) : max(b/u, y/v) : 1, here times min(u, v), so
/// that nothing overflows. A source that leaves no unknown is the limit of one that leaves next to none.
struct Cautious {
  static constexpr bool kTotalPossible = false;
  template <class State, class V>
  static EVIGRID_FN Combined<V> combine(const Cell<V>& c, const PlainSource<V>& m) {
    const V zero(0.0f), one(1.0f);
    const V less = min_of(c.u, m.v), more = max_of(c.u, m.v);
    const V ratio = less / select(more > zero, more, one);
    const V ru = select(c.u >= m.v, one, ratio), rv = select(m.v >= c.u, one, ratio);
    return {over_sum(max_of(c.a * rv, m.x * ru), max_of(c.b * rv, m.y * ru), less), conflict_between(c, m)};
  }
};

/// Bayes with prior ½ on the pignistic probabilities P = o + u/2 (Moravec 1988): odds multiply. Both certain and
/// opposite: ½, and counted.
struct Bayes {
  static constexpr bool kTotalPossible = true;
  template <class State, class V>
  static EVIGRID_FN auto combine(const Cell<V>& c, const PlainSource<V>& m) {
    const V zero(0.0f), one(1.0f), half(0.5f);
    V e = ((c.a + c.a) + c.u) * ((m.x + m.x) + m.v), o = ((c.b + c.b) + c.u) * ((m.y + m.y) + m.v);
    V sum = e + o;
    const auto total = sum <= zero;
    const V up = select(sum < V(kTiny), V(1.2676506e30f), one);  // 2^100: 1/sum must be finite
    e = e * up, o = o * up, sum = sum * up;
    const V r = one / select(total, one, sum);
    return CombinedOrTotal<V, std::remove_const_t<decltype(total)>>{
        {select(total, half, e * r), select(total, half, o * r), zero}, conflict_between(c, m), total};
  }
};

/// Fuzzy union by the algebraic sum (Oriolo, Ulivi & Vendittelli 1997), of the memberships of empty and of occupied;
/// unknown = neither = (1 − e)(1 − o), the paradox = both = e·o.
struct Fuzzy {
  static constexpr bool kTotalPossible = false;
  template <class State, class V>
  static EVIGRID_FN CombinedOpen<V> combine(const Cell<V>& c, const PlainSource<V>& m) {
    const V e = algebraic_sum(c.a, m.x), o = algebraic_sum(c.b, m.y), one(1.0f);
    return {{e, o, (one - e) * (one - o)}, conflict_between(c, m), e * o};
  }
  template <class V>
  static EVIGRID_FN V algebraic_sum(const V& a, const V& b) {  // never above 1, exact next to 0
    const V more = max_of(a, b);
    return more + min_of(a, b) * (V(1.0f) - more);
  }
};

EVIGRID_CELL_END
