// SPDX-License-Identifier: Apache-2.0
// States that add up. Dempster's rule on log-weights: a source (x, y, v) is the two simple supports with weights
// l1 = ln(1 + x/v) and l2 = ln(1 + y/v) (Shafer 1976, ch. 5: weights of evidence add), so a cell never saturates.
// Sums are whole multiples of 2^-23: exact, the same bits in any order of readings, and a reading is taken back by
// subtracting it. Murphy's average (2000): sums of the masses and their number. Bayes: log-odds between two limits.
#pragma once
#include "kernels/cell/poly.hpp"
#include "kernels/cell/state.hpp"

EVIGRID_CELL_BEGIN

/// A sum as whole + rest · 2^-23, both whole numbers held exactly in floats: |rest| ≤ 2^22, |whole| < 2^24.
template <class V>
struct FixedSum {
  V whole, rest;
};
inline constexpr float kRestUnit = 1.1920929e-7f, kRestsInOne = 8388608.0f;  // 2^-23, 2^23

/// s + round(l · 2^23) / 2^23; adding −l afterwards restores the bits.
template <class V>
EVIGRID_FN FixedSum<V> add(const FixedSum<V>& s, const LogParts<V>& l) {
  const V magic(12582912.0f), zero(0.0f), one(1.0f), unit(kRestsInOne), half(0.5f * kRestsInOne);
  const V n = (l.large + magic) - magic;
  const V rest = (s.rest + (l.large - n) * unit) + ((l.small * unit + magic) - magic);  // whole numbers below 2^24
  const V carry = select(rest >= half, one, select(rest < zero - half, zero - one, zero));
  return {(s.whole + n) + carry, neg_mul_add(carry, unit, rest)};
}
template <class V>
EVIGRID_FN LogParts<V> times(const V& sign, const LogParts<V>& l) {
  return {sign * l.large, sign * l.small};
}
template <class V>
EVIGRID_FN V value_of(const FixedSum<V>& s) {
  return mul_add(s.rest, V(kRestUnit), s.whole);
}
/// a − b: as exact as the difference itself can be held.
template <class V>
EVIGRID_FN V difference(const FixedSum<V>& a, const FixedSum<V>& b) {
  return mul_add(a.rest - b.rest, V(kRestUnit), a.whole - b.whole);
}

/// The same for |x| ≤ 1.
template <class V>
EVIGRID_FN FixedSum<V> add_share(const FixedSum<V>& s, const V& x) {
  const V magic(12582912.0f), n = (x + magic) - magic;
  return add(s, LogParts<V>{n, x - n});
}

/// Masses of the weights l1, l2 ≥ 0 with l1 − l2 = d: (1 − w1)·w2 : (1 − w2)·w1 : w1·w2 with w = e^−l, all divided by
/// the larger w.
template <class V>
EVIGRID_FN Masses<V> of_weights(const V& l1, const V& l2, const V& d) {
  const V zero(0.0f), one(1.0f), far(-69.0f);  // e^-69 = 1.1e-30: what is smaller is floored
  const V size = max_of(d, zero - d);
  const V f = exponential(max_of(zero - size, far)).value, g = exponential(max_of(zero - max_of(l1, l2), far)).value;
  const V f1 = select(d > zero, f, one), f2 = select(d < zero, f, one);
  const V r = one / ((f1 + f2) - g);
  const V said1 = zero - exponential(max_of(zero - l1, far)).less_one,
          said2 = zero - exponential(max_of(zero - l2, far)).less_one;
  return settled(said1 * (f2 * r), said2 * (f1 * r), g * r);
}

struct LogWeights {
  static constexpr int kPlanes = 4;
  static constexpr bool kTotalPossible = false;
  template <bool kConflict, class V, class S>
  static EVIGRID_FN Update<V, kPlanes> update(const V (&old)[kPlanes], const S& source, const RuleArgs& args) {
    const S m = drop_paradox(source);
    const V v = unknown_of<V>(m), sign(args.sign);
    const FixedSum<V> l1 = add(FixedSum<V>{old[0], old[1]}, times(sign, log_one_plus_parts(m.x / v))),
                      l2 = add(FixedSum<V>{old[2], old[3]}, times(sign, log_one_plus_parts(m.y / v)));
    V k(0.0f);
    if constexpr (kConflict) k = conflict_with(read(old), m);
    return {{l1.whole, l1.rest, l2.whole, l2.rest}, k};
  }
  template <class V>
  static EVIGRID_FN Masses<V> read(const V (&p)[kPlanes]) {
    const FixedSum<V> s1{p[0], p[1]}, s2{p[2], p[3]};
    const V zero(0.0f), l1 = value_of(s1), l2 = value_of(s2);
    const auto sound = min_of(l1, l2) >= zero;  // not so when more was taken back than ever came
    return of_weights(max_of(l1, zero), max_of(l2, zero), select(sound, difference(s1, s2), zero));
  }
};

/// The mean of all readings so far, with itself n − 1 times by Dempster's rule. k is the mean's with the new reading.
struct MeanCells {
  static constexpr int kPlanes = 5;  // sums of x and of y, number
  static constexpr bool kTotalPossible = false;
  template <bool kConflict, class V, class S>
  static EVIGRID_FN Update<V, kPlanes> update(const V (&old)[kPlanes], const S& source, const RuleArgs& args) {
    const S m = drop_paradox(source);
    const V sign(args.sign);
    V x = m.x, y = m.y;
    if constexpr (requires { m.z; }) {
      const V r = V(1.0f) / m.s;
      x = x * r, y = y * r;
    }
    const FixedSum<V> sx{old[0], old[1]}, sy{old[2], old[3]};
    const FixedSum<V> nx = add_share(sx, sign * x), ny = add_share(sy, sign * y);
    V k(0.0f);
    if constexpr (kConflict) k = (value_of(sx) * y + value_of(sy) * x) / max_of(old[4], V(1.0f));
    return {{nx.whole, nx.rest, ny.whole, ny.rest, old[4] + sign}, k};
  }
  template <class V>
  static EVIGRID_FN Masses<V> read(const V (&p)[kPlanes]) {
    const V zero(0.0f), n = max_of(p[4], zero);
    const FixedSum<V> x{p[0], p[1]}, y{p[2], p[3]};
    // What is left of n, exactly; and no less than the floor, also for no reading at all.
    const V left = neg_mul_add(p[1] + p[3], V(kRestUnit), n - (p[0] + p[2]));
    const V v = max_of(left, V(kLeastUnknown) * max_of(n, V(1.0f)));
    const V sx = max_of(value_of(x), zero), sy = max_of(value_of(y), zero), gap = difference(x, y);
    // n·ln((a + u)/(b + u)) as one logarithm: the difference of two large ones would be lost in their rounding.
    const V d = n * log_one_plus(max_of(gap, zero - gap) / (min_of(sx, sy) + v));
    return of_weights(n * log_one_plus(sx / v), n * log_one_plus(sy / v), select(gap < zero, zero - d, d));
  }
};

/// Bayes with prior ½ and independent readings: L = ln(P/(1 − P)) grows by ln(p/q), p = y + share·v and q = x + share·v
/// the source's likelihoods: BetP with a share of ½, PlP with 1. Read as (1 − P, P, 0), vacuous where L = 0.
struct LogOdds {
  static constexpr int kPlanes = 1;
  static constexpr bool kTotalPossible = false;
  static constexpr float kLeastLikelihood = 1e-6f;
  template <bool kConflict, class V, class S>
  static EVIGRID_FN Update<V, kPlanes> update(const V (&old)[kPlanes], const S& source, const RuleArgs& args) {
    const S m = drop_paradox(source);
    const V zero(0.0f), p = gap_of<V>(m), size = max_of(p, zero - p);
    const V least = mul_add(m.v, V(args.unknown_share), min_of(m.x, m.y));
    const V step = log_one_plus(size / max_of(least, V(kLeastLikelihood) * scale(m)));
    const V l = old[0] + select(p < zero, zero - step, step);
    V k(0.0f);
    if constexpr (kConflict) k = conflict_with(read(old), m);
    return {{max_of(min_of(l, V(args.most_log_odds)), V(args.least_log_odds))}, k};
  }
  template <class V>
  static EVIGRID_FN Masses<V> read(const V (&p)[kPlanes]) {
    const V zero(0.0f), one(1.0f), l = p[0];
    const V t = exponential(max_of(zero - max_of(l, zero - l), V(-27.0f))).value, r = one / (one + t);
    const V more = r, less = t * r;
    const auto up = l > zero, down = l < zero;
    return {select(up, less, select(down, more, zero)), select(up, more, select(down, less, zero)),
            select(either(up, down), zero, one), zero};
  }
};

EVIGRID_CELL_END
