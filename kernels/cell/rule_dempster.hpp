// SPDX-License-Identifier: Apache-2.0
// Dempster's rule (Shafer 1976): the conjunctive part divided by its own sum e + o + t, never by 1 − k, whose float
// error lets Σm leave 1. Total conflict (a sum of 0; in a map below 1e-12) answers with the vacuous mass and is
// counted.
#pragma once
#include "kernels/cell/mass.hpp"

EVIGRID_CELL_BEGIN

struct Dempster {
  static constexpr Paradox kParadox = kDropped;
  static constexpr bool kTotalPossible = true;
  template <class State, class V, class S>
  static EVIGRID_FN auto combine(const Cell<V>& c, const S& source) {
    const S m = drop_paradox(source);
    const V zero(0.0f), one(1.0f);
    if constexpr (kBothNormalised<State, S>) {
      const Conjunctive<V> q = conjunctive_in_map(c, m);
      const V sum = (q.e + q.o) + q.t;
      const auto total = sum <= V(State::kTotal);
      const V r = one / max_of(sum, V(State::kTotal));
      const Cell<V> next = settle<State>(Cell<V>{q.e * r, q.o * r, q.t * r});
      return CombinedOrTotal<V, std::remove_const_t<decltype(total)>>{
          {select(total, zero, next.a), select(total, zero, next.b), select(total, one, next.u)},
          select(total, one, q.k),
          total};
    } else {
      return combine_at_large<State>(c, m);
    }
  }
  template <class State, class V, class S>
  static EVIGRID_FN auto combine_at_large(const Cell<V>& c, const S& m) {
    Conjunctive<V> q = conjunctive(c, m);
    const V k = q.k, zero(0.0f), one(1.0f);
    V sum = (q.e + q.o) + q.t;
    const auto total = sum <= V(State::kTotal) * scale(m);
    V all = sum + k;                  // the source's sum up to rounding
    if constexpr (!State::kFloors) {  // a sum as small as a denormal is still divided exactly
      const V up = select(sum < V(kTiny), V(1.2676506e30f), one);  // 2^100
      q.e = q.e * up, q.o = q.o * up, q.t = q.t * up, sum = sum * up;
    }
    // One division serves the masses (/ sum) and k (/ all).
    const V r = one / select(total, one, sum * all);
    const V w = r * all;
    const Cell<V> next = settle<State>(Cell<V>{q.e * w, q.o * w, q.t * w});
    return CombinedOrTotal<V, std::remove_const_t<decltype(total)>>{
        {select(total, zero, next.a), select(total, zero, next.b), select(total, one, next.u)},
        select(total, one, conflict_of(m, k, sum * r)),
        total};
  }
};

EVIGRID_CELL_END
