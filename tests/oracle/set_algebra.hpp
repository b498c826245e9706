// SPDX-License-Identifier: Apache-2.0
// Belief functions on bit-mask focal elements (the rules: set_rules.hpp). A mask is a set of parts of the Venn diagram
// of the hypotheses; an integrity constraint says which parts are impossible. Runs on any number type (exact rationals,
// double).
#pragma once
#include <array>
#include <vector>

namespace oracle {

/// m[mask] = mass on that set of Venn parts.
template <class T, unsigned Parts>
using Belief = std::array<T, 1U << Parts>;

/// The hypotheses as sets of Venn parts, and the parts that the constraint declares empty.
struct Frame {
  std::vector<unsigned> hypotheses;
  unsigned impossible = 0;
  [[nodiscard]] bool is_empty(unsigned mask) const { return (mask & ~impossible) == 0; }
};

template <class T, unsigned Parts>
struct Combined {
  Belief<T, Parts> m{};
  T conflict = T(0);            ///< product mass on the empty set
  T made = T(0);                ///< of it what comes from two sets that are not empty themselves
  bool total_conflict = false;  ///< Dempster had nothing to divide by
};

/// Divides by the sum; answers false when the sum is 0 or below `least`.
template <class T, unsigned Parts>
bool divide_by_sum(Belief<T, Parts>& m, const T& least = T(0)) {
  T sum(0);
  for (const T& x : m) sum += x;
  if (sum == 0 || sum < least) return false;
  for (T& x : m)
    if (x != 0) x /= sum;
  return true;
}

/// Drops what a belief puts on empty sets and divides the rest by its sum (vacuous when nothing is left). A belief
/// without such mass is taken as it is.
template <class T, unsigned Parts>
Belief<T, Parts> drop_empty(const Frame& frame, Belief<T, Parts> m) {
  bool any = false;
  for (unsigned x = 0; x < m.size(); ++x)
    if (m[x] != 0 && frame.is_empty(x)) m[x] = T(0), any = true;
  if (any && !divide_by_sum<T, Parts>(m)) m.back() = T(1);
  return m;
}

/// Gives what a belief puts on empty sets back to the hypotheses whose intersection they are, in proportion to the mass
/// of these, or in equal shares where they have none.
template <class T, unsigned Parts>
Belief<T, Parts> give_back_empty(const Frame& frame, const Belief<T, Parts>& m) {
  Belief<T, Parts> out = m;
  for (unsigned x = 1; x < m.size(); ++x) {
    if (m[x] == 0 || !frame.is_empty(x)) continue;
    T total(0), count(0);
    for (unsigned h : frame.hypotheses)
      if ((h & x) == x) total += m[h], count += T(1);
    for (unsigned h : frame.hypotheses) {
      if ((h & x) != x) continue;
      const T share = total == 0 ? T(T(1) / count) : T(m[h] / total);
      out[h] += T(m[x] * share);
    }
    out[x] = T(0);
  }
  return out;
}

/// The conjunctive rule: every product goes to the intersection; those on empty sets are summed as the conflict.
template <class T, unsigned Parts>
Combined<T, Parts> conjunctive(const Frame& frame, const Belief<T, Parts>& m1, const Belief<T, Parts>& m2) {
  Combined<T, Parts> out;
  for (unsigned x = 0; x < m1.size(); ++x)
    for (unsigned y = 0; y < m2.size(); ++y) {
      if (m1[x] == 0 || m2[y] == 0) continue;
      const T product = m1[x] * m2[y];
      if (frame.is_empty(x & y)) {
        out.conflict += product;
        if (!frame.is_empty(x) && !frame.is_empty(y)) out.made += product;
      } else {
        out.m[x & y] += product;
      }
    }
  return out;
}

/// The frame of a cell: Venn parts 1 = only empty, 2 = only occupied, 4 = both, which cannot be.
inline constexpr unsigned kEmpty = 5, kOccupied = 6, kUnknown = 7, kBoth = 4;
inline const Frame& cell_frame() {
  static const Frame frame{{kEmpty, kOccupied}, kBoth};
  return frame;
}

}  // namespace oracle
