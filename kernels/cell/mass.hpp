// SPDX-License-Identifier: Apache-2.0
// One cell and one source of evidence on the frame {empty, occupied}; V is one number (lane_*.hpp). Letters as in
// docs/maths.md: the cell is (a, b, u), the source (x, y, v) with its paradoxical mass z. A source may be unnormalised:
// s is the sum of its masses, and every rule is homogeneous in the source, so that the one division at the end does for
// model and rule together. Copies are made mass by mass: copied as a whole, gcc 12 keeps them on the stack.
#pragma once
#include <type_traits>

#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

template <class V>
struct Cell {
  V a, b, u;  // m(empty), m(occupied), m(unknown)
};

template <class V>
struct Source {
  static constexpr bool kYields = false;
  V x, y, v, z, s;  // m(empty), m(occupied), m(unknown), m(empty ∩ occupied), their sum
};

/// A source without paradoxical mass, already normalised: its sum is 1 and costs nothing.
template <class V>
struct PlainSource {
  static constexpr bool kYields = false;
  V x, y, v;
};

/// A source whose masses may lie far below their sum (li2006 at its edges): share = z/(x + y), so that the paradoxical
/// mass can be given back without a small scale.
template <class V>
struct FaintSource {
  static constexpr bool kYields = false;
  V x, y, v, z, s, share;
};

/// Memberships whose occupied part gives way to what the cell knows of empty: y(1 − e) (moravec1985).
template <class V>
struct YieldingSource {
  static constexpr bool kYields = true;
  V x, y, v;
};

/// A probability as the Bayesian mass (x, y, 0), with gap = y − x right relatively: near ½ that difference is all it
/// says.
template <class V>
struct ProbabilitySource {
  static constexpr bool kYields = false;
  V x, y, v, gap;
};

template <class V>
EVIGRID_FN V scale(const Source<V>& m) {
  return m.s;
}
template <class V>
EVIGRID_FN V scale(const FaintSource<V>& m) {
  return m.s;
}
template <class V>
EVIGRID_FN V scale(const PlainSource<V>&) {
  return V(1.0f);
}
template <class V>
EVIGRID_FN V scale(const ProbabilitySource<V>&) {
  return V(1.0f);
}
/// y − x.
template <class V, class S>
EVIGRID_FN V gap_of(const S& m) {
  if constexpr (requires { m.gap; }) {
    return m.gap;
  } else {
    return m.y - m.x;
  }
}

/// Two-sided sources of maps: a normalised cell and a normalised source, for which some rules have a shorter text.
template <class State, class S>
inline constexpr bool kBothNormalised = false;
template <class State, class V>
inline constexpr bool kBothNormalised<State, PlainSource<V>> = State::kFloors;

/// What a rule does with a source's paradoxical mass before anything else. Rules that do not say take it in themselves.
template <class Rule>
constexpr Paradox paradox_of() {
  if constexpr (requires { Rule::kParadox; }) {
    return Rule::kParadox;
  } else {
    return kConsumed;
  }
}

/// What one combination gives: the new cell and the conflict k of the two normalised operands. Rules that can meet
/// total conflict (Rule::kTotalPossible) say where they did: the cell is then vacuous, by policy.
template <class V>
struct Combined {
  Cell<V> cell;
  V k;
};
template <class V, class M>
struct CombinedOrTotal {
  Cell<V> cell;
  V k;
  M total;
};

/// Numbers of a map: small masses become exact zeros, so that no denormal ever arises and a host that flushes them to
/// zero gets the same bits. Numbers of `combine`: exact, no floor.
struct MapState {
  static constexpr bool kFloors = true;
  static constexpr float kMassFloor = 1e-12f;
  static constexpr float kUnknownFloor = 1e-30f;
  static constexpr float kTotal = 1e-12f;  // e + o + t below this is total conflict
};
struct Exact {
  static constexpr bool kFloors = false;
  static constexpr float kMassFloor = 0, kUnknownFloor = 0, kTotal = 0;
};

/// A divisor this small has a dividend below its square: the quotient is taken as zero by dividing by 1 instead.
inline constexpr float kTiny = 1e-15f;
template <class V>
EVIGRID_FN V nonzero(const V& d) {
  return select(d > V(kTiny), d, V(1.0f));
}

/// A source's mass below 1e-20 is taken as 0, so that no product with a cell becomes denormal.
template <class V>
EVIGRID_FN V settle_source(const V& m) {
  return select(m >= V(1e-20f), m, V(0.0f));
}

template <class State, class V>
EVIGRID_FN Cell<V> settle(const Cell<V>& c) {
  if constexpr (State::kFloors) {
    const V zero(0.0f), least(State::kMassFloor);
    return {select(c.a >= least, c.a, zero), select(c.b >= least, c.b, zero), max_of(c.u, V(State::kUnknownFloor))};
  } else {
    return {c.a, c.b, c.u};
  }
}

/// k of the two normalised operands, from k·(source's sum): a plain source is normalised already.
template <class V>
EVIGRID_FN V conflict_of(const Source<V>&, const V& k, const V& inverse_sum) {
  return k * inverse_sum;
}
template <class V>
EVIGRID_FN V conflict_of(const FaintSource<V>&, const V& k, const V& inverse_sum) {
  return k * inverse_sum;
}
template <class V>
EVIGRID_FN V conflict_of(const PlainSource<V>&, const V& k, const V&) {
  return k;
}

/// The conjunctive part; the order of additions makes it commutative and mirror-symmetric bit for bit.
template <class V>
struct Conjunctive {
  V e, o, t, k;
};
template <class V, class S>
EVIGRID_FN Conjunctive<V> conjunctive(const Cell<V>& c, const S& m) {
  return {c.a * m.x + (c.a * m.v + c.u * m.x), c.b * m.y + (c.b * m.v + c.u * m.y), c.u * m.v, c.a * m.y + c.b * m.x};
}

/// The same where a cell of a map, which has no double role, is a and the source x: with fused additions.
template <class V>
EVIGRID_FN Conjunctive<V> conjunctive_in_map(const Cell<V>& c, const PlainSource<V>& m) {
  return {mul_add(c.a, m.x + m.v, c.u * m.x), mul_add(c.b, m.y + m.v, c.u * m.y), c.u * m.v,
          mul_add(c.a, m.y, c.b * m.x)};
}

/// Shafer's discount: every mass times `reliability`, the rest becomes unknown. `doubt` is 1 − reliability, rounded
/// from double: 1 − 0.9f would be off by 2e-7 of itself, in every update the same way.
template <class V>
EVIGRID_FN Source<V> discount(const Source<V>& m, const V& reliability, const V& doubt) {
  const V x = m.x * reliability, y = m.y * reliability, z = m.z * reliability;
  return {x, y, mul_add(m.v, reliability, m.s * doubt), z, m.s};
}

template <class V>
EVIGRID_FN PlainSource<V> discount(const PlainSource<V>& m, const V& reliability, const V& doubt) {
  return {m.x * reliability, m.y * reliability, mul_add(m.v, reliability, doubt)};
}

template <class V>
EVIGRID_FN FaintSource<V> discount(const FaintSource<V>& m, const V& reliability, const V& doubt) {
  return {
      m.x * reliability, m.y * reliability, mul_add(m.v, reliability, m.s * doubt), m.z * reliability, m.s, m.share};
}

template <class V>
EVIGRID_FN ProbabilitySource<V> discount(const ProbabilitySource<V>& m, const V& reliability, const V& doubt) {
  return {m.x * reliability, m.y * reliability, mul_add(m.v, reliability, doubt), m.gap * reliability};
}

template <class V>
EVIGRID_FN YieldingSource<V> discount(const YieldingSource<V>& m, const V& reliability, const V& doubt) {
  return {m.x * reliability, m.y * reliability, mul_add(m.v, reliability, doubt)};
}

/// The PCR family gives a source's paradoxical mass back to x and y in proportion, halves if both are 0.
/// Everything is multiplied through by x + y, so that this costs no division.
template <class V>
EVIGRID_FN Source<V> give_back(const Source<V>& m) {
  const V p = m.x + m.y, t = p + m.z, zero(0.0f), half = V(0.5f) * m.z;
  const auto shared = p > zero;
  return {select(shared, m.x * t, half), select(shared, m.y * t, half), select(shared, m.v * p, m.v), zero,
          select(shared, m.s * p, m.s)};
}

template <class V>
EVIGRID_FN PlainSource<V> give_back(const PlainSource<V>& m) {
  return {m.x, m.y, m.v};
}

template <class V>
EVIGRID_FN FaintSource<V> give_back(const FaintSource<V>& m) {
  return {mul_add(m.x, m.share, m.x), mul_add(m.y, m.share, m.y), m.v, V(0.0f), m.s, V(0.0f)};
}

/// Rules without a place for the paradoxical mass drop it.
template <class V>
EVIGRID_FN Source<V> drop_paradox(const Source<V>& m) {
  return {m.x, m.y, m.v, V(0.0f), (m.x + m.y) + m.v};
}
template <class V>
EVIGRID_FN PlainSource<V> drop_paradox(const PlainSource<V>& m) {
  return {m.x, m.y, m.v};
}

template <class V>
EVIGRID_FN FaintSource<V> drop_paradox(const FaintSource<V>& m) {
  return {m.x, m.y, m.v, V(0.0f), (m.x + m.y) + m.v, V(0.0f)};
}

template <class V>
EVIGRID_FN ProbabilitySource<V> drop_paradox(const ProbabilitySource<V>& m) {
  return {m.x, m.y, m.v, m.gap};
}

/// A source as memory holds it (kernel_table.hpp, Measured), and back: it keeps its kind, so that the fused and the
/// unfused path run the same functions.
template <class V>
struct Parts {
  V part[6];
};
template <class V>
EVIGRID_FN Parts<V> widen(const Source<V>& m) {
  return {{m.x, m.y, m.v, m.z, m.s, V(0.0f)}};
}
template <class V>
EVIGRID_FN Parts<V> widen(const FaintSource<V>& m) {
  return {{m.x, m.y, m.v, m.z, m.s, m.share}};
}
template <class V>
EVIGRID_FN Parts<V> widen(const PlainSource<V>& m) {
  return {{m.x, m.y, m.v, V(0.0f), V(1.0f), V(0.0f)}};
}
template <class V>
EVIGRID_FN Parts<V> widen(const YieldingSource<V>& m) {
  return {{m.x, m.y, m.v, V(0.0f), V(1.0f), V(0.0f)}};
}
template <class V>
EVIGRID_FN Parts<V> widen(const ProbabilitySource<V>& m) {
  return {{m.x, m.y, m.v, V(0.0f), V(1.0f), m.gap}};
}
template <class Kind, class V>
EVIGRID_FN Kind narrow(const Parts<V>& p) {
  const auto& m = p.part;
  if constexpr (requires(Kind k) { k.share; }) {
    return {m[0], m[1], m[2], m[3], m[4], m[5]};
  } else if constexpr (requires(Kind k) { k.z; }) {
    return {m[0], m[1], m[2], m[3], m[4]};
  } else if constexpr (requires(Kind k) { k.gap; }) {
    return {m[0], m[1], m[2], m[5]};
  } else {
    return {m[0], m[1], m[2]};
  }
}

EVIGRID_CELL_END
