// SPDX-License-Identifier: Apache-2.0
// What a map keeps of a cell under a rule, its state: planes of floats, how a reading changes them (update) and which
// masses they mean (read). Here: states of masses (e, o, u), with a plane for the mass on empty ∩ occupied where the
// rule keeps one, of memberships, and of the larger weights. state_sums.hpp has those that add up.
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/cell/rule_batch.hpp"
#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

template <class V, int kPlanes>
struct Update {
  V plane[kPlanes];
  V k;  // conflict of the cell as it was and the source, both normalised
};
template <class V, int kPlanes, class M>
struct UpdateOrTotal {
  V plane[kPlanes];
  V k;
  M total;
};

/// What a state means: e, o, u, and c = m(∅) of the open world or m(empty ∩ occupied).
template <class V>
struct Masses {
  V e, o, u, c;
};

/// Sources that leave less unknown than this are taken to leave this much, by states that keep weights x/v.
inline constexpr float kLeastUnknown = 1e-4f;
template <class V, class S>
EVIGRID_FN V unknown_of(const S& m) {
  return max_of(m.v, V(kLeastUnknown) * scale(m));
}
/// a·y + b·x of the cell's masses and the normalised source.
template <class V, class S>
EVIGRID_FN V conflict_with(const Masses<V>& c, const S& m) {
  const V k = c.e * m.y + c.o * m.x;
  if constexpr (requires { m.z; }) {
    return k / m.s;
  } else {
    return k;
  }
}
template <class V>
EVIGRID_FN Masses<V> settled(const V& e, const V& o, const V& u) {
  const Cell<V> c = settle<MapState>(Cell<V>{e, o, u});
  return {c.a, c.b, c.u, V(0.0f)};
}

/// Rules whose cell is (e, o, u).
template <class Rule>
struct MassCells {
  static constexpr Paradox kParadox = paradox_of<Rule>();
  static constexpr int kPlanes = 3;
  static constexpr bool kTotalPossible = Rule::kTotalPossible;
  template <bool kConflict, class V, class S>
  static EVIGRID_FN auto update(const V (&old)[kPlanes], const S& source, const RuleArgs&) {
    const auto r = Rule::template combine<MapState>(Cell<V>{old[0], old[1], old[2]}, source);
    if constexpr (kTotalPossible) {
      return UpdateOrTotal<V, kPlanes, std::remove_const_t<decltype(r.total)>>{
          {r.cell.a, r.cell.b, r.cell.u}, r.k, r.total};
    } else {
      return Update<V, kPlanes>{{r.cell.a, r.cell.b, r.cell.u}, r.k};
    }
  }
  template <class V>
  static EVIGRID_FN Masses<V> read(const V (&p)[kPlanes]) {
    return {p[0], p[1], p[2], V(0.0f)};
  }
};

/// Smets's conjunctive rule and DSmC: (e, o, u, c), the conflict stays as c. All that is not c shrinks with every
/// conflict while its proportions still count: the floor is 1e-30 for each.
struct OpenCells {
  static constexpr int kPlanes = 4;
  static constexpr bool kTotalPossible = false;
  static constexpr float kFloor = MapState::kUnknownFloor;
  template <bool kConflict, class V, class S>
  static EVIGRID_FN Update<V, kPlanes> update(const V (&old)[kPlanes], const S& m, const RuleArgs&) {
    const Conjunctive<V> q = conjunctive(Cell<V>{old[0], old[1], old[2]}, m);
    V c = mul_add(old[3], scale(m), q.k);  // n(x + y + v + z) + k
    if constexpr (requires { m.z; }) c = c + m.z * ((old[0] + old[1]) + old[2]);
    const V r = V(1.0f) / ((q.e + q.o) + (q.t + c)), floor(kFloor);
    return {{kept(q.e * r), kept(q.o * r), max_of(q.t * r, floor), kept(c * r)}, conflict_of(m, q.k, r)};
  }
  template <class V>
  static EVIGRID_FN V kept(const V& x) {
    return select(x >= V(kFloor), x, V(0.0f));
  }
  template <class V>
  static EVIGRID_FN Masses<V> read(const V (&p)[kPlanes]) {
    return {p[0], p[1], p[2], p[3]};
  }
};

/// Memberships ψ of empty and ω of occupied, joined by the algebraic sum (Oriolo, Ulivi & Vendittelli 1997). Read as
/// the batch gives them: e = ψ, o = ω, u neither, c both.
struct Memberships {
  static constexpr int kPlanes = 2;
  static constexpr bool kTotalPossible = false;
  template <bool kConflict, class V, class S>
  static EVIGRID_FN Update<V, kPlanes> update(const V (&old)[kPlanes], const S& m, const RuleArgs&) {
    V x = m.x, y = m.y;
    if constexpr (requires { m.z; }) {
      const V r = V(1.0f) / m.s;
      x = x * r, y = y * r;
    }
    const V one(1.0f);
    x = min_of(x, one), y = min_of(y, one);  // a model's float error must not make a membership more than whole
    const V empty = kept(Fuzzy::algebraic_sum(old[0], x)), k = old[0] * y + old[1] * x;
    if constexpr (S::kYields) y = y * (one - empty);  // Moravec & Elfes 1985: Occ' = O(1 − Emp)
    return {{empty, kept(Fuzzy::algebraic_sum(old[1], y))}, k};
  }
  template <class V>
  static EVIGRID_FN V kept(const V& x) {
    return select(x >= V(MapState::kMassFloor), x, V(0.0f));
  }
  template <class V>
  static EVIGRID_FN Masses<V> read(const V (&p)[kPlanes]) {
    const V one(1.0f);
    return {p[0], p[1], (one - p[0]) * (one - p[1]), p[0] * p[1]};
  }
};

/// Denœux's cautious rule (2008): the larger weight of each hypothesis ever said, l = ln(1 + x/v), kept as x/v. The
/// same reading again changes no bit.
struct LargerWeights {
  static constexpr int kPlanes = 2;
  static constexpr bool kTotalPossible = false;
  template <bool kConflict, class V, class S>
  static EVIGRID_FN Update<V, kPlanes> update(const V (&old)[kPlanes], const S& source, const RuleArgs&) {
    const S m = drop_paradox(source);
    const V v = unknown_of<V>(m);
    V k(0.0f);
    if constexpr (kConflict) k = conflict_with(read(old), m);
    return {{max_of(old[0], m.x / v), max_of(old[1], m.y / v)}, k};
  }
  template <class V>
  static EVIGRID_FN Masses<V> read(const V (&p)[kPlanes]) {
    const V one(1.0f), r = one / ((p[0] + p[1]) + one);
    return settled(p[0] * r, p[1] * r, r);
  }
};

EVIGRID_CELL_END
