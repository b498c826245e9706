// SPDX-License-Identifier: Apache-2.0
// The combination rules as their authors define them: sums over all pairs of focal elements, nothing closed-form, each
// rule for itself even where it is known to coincide with another. Runs on any number type.
#pragma once
#include <algorithm>

#include "evigrid/types.hpp"
#include "tests/oracle/set_algebra.hpp"

namespace oracle {

/// The conflict as a whole goes to `recipients` in proportion to their column sums m1 + m2; to ignorance where those
/// are 0.
template <class T, unsigned Parts>
void share_by_columns(Combined<T, Parts>& out, const Belief<T, Parts>& m1, const Belief<T, Parts>& m2,
                      const std::vector<bool>& recipients) {
  T columns(0);
  for (unsigned x = 0; x < m1.size(); ++x)
    if (recipients[x]) columns += T(m1[x] + m2[x]);
  if (out.conflict == 0) return;
  if (columns == 0) {
    out.m.back() += out.conflict;
    return;
  }
  for (unsigned x = 0; x < m1.size(); ++x) {
    if (!recipients[x]) continue;
    const T column = m1[x] + m2[x];
    if (column != 0) out.m[x] += T(out.conflict * T(column / columns));
  }
}

/// PCR2: the sets involved in the conflict are those that meet a set of the other source in nothing.
template <class T, unsigned Parts>
std::vector<bool> involved(const Frame& frame, const Belief<T, Parts>& m1, const Belief<T, Parts>& m2) {
  std::vector<bool> out(m1.size(), false);
  for (unsigned x = 0; x < m1.size(); ++x)
    for (unsigned y = 0; y < m2.size(); ++y) {
      if (!frame.is_empty(x & y) || m1[x] == 0 || m2[y] == 0) continue;
      out[x] = out[y] = true;
    }
  return out;
}

/// GERM-PCR2: the non-empty sets that exclude one of the hypotheses, whoever names them.
template <class T, unsigned Parts>
std::vector<bool> exclusive(const Frame& frame) {
  std::vector<bool> out(1U << Parts, false);
  for (unsigned x = 1; x < out.size(); ++x)
    for (unsigned h : frame.hypotheses)
      if (!frame.is_empty(x) && frame.is_empty(x & h)) out[x] = true;
  return out;
}

/// PCR5: every conflicting product goes back to the two sets that made it, in proportion to what each put in.
template <class T, unsigned Parts>
void share_by_products(Combined<T, Parts>& out, const Frame& frame, const Belief<T, Parts>& m1,
                       const Belief<T, Parts>& m2) {
  for (unsigned x = 0; x < m1.size(); ++x)
    for (unsigned y = 0; y < m2.size(); ++y) {
      if (!frame.is_empty(x & y) || m1[x] == 0 || m2[y] == 0) continue;
      const T product = m1[x] * m2[y], sum = m1[x] + m2[y];
      out.m[x] += T(product * T(m1[x] / sum));
      out.m[y] += T(product * T(m2[y] / sum));
    }
}

/// PCR1: everybody with a column has a share, ignorance too.
template <class T, unsigned Parts>
void share_by_all_columns(Combined<T, Parts>& out, const Belief<T, Parts>& m1, const Belief<T, Parts>& m2) {
  share_by_columns<T, Parts>(out, m1, m2, std::vector<bool>(m1.size(), true));
}

/// PCR3 and PCR4: the products of two sets that exclude each other go to these two, in proportion to their columns
/// (PCR3), or to their conjunctive masses unless one of those is `zero` or less (PCR4).
template <class T, unsigned Parts>
void share_by_pairs(Combined<T, Parts>& out, const Frame& frame, const Belief<T, Parts>& m1, const Belief<T, Parts>& m2,
                    bool by_conjunctive, const T& zero) {
  const Belief<T, Parts> conjunctive = out.m;
  for (unsigned a = 1; a < m1.size(); ++a)
    for (unsigned x = 1; x < m1.size(); ++x) {
      if (!frame.is_empty(a & x) || frame.is_empty(a) || frame.is_empty(x)) continue;
      const T partial = T(m1[x] * m2[a]) + T(m1[a] * m2[x]);
      if (partial == 0) continue;
      const bool columns = !by_conjunctive || conjunctive[a] <= zero || conjunctive[x] <= zero;
      const T mine = columns ? T(m1[a] + m2[a]) : conjunctive[a], other = columns ? T(m1[x] + m2[x]) : conjunctive[x];
      out.m[a] += T(partial * T(mine / T(mine + other)));
    }
}

/// PCR6 (Martin & Osswald): what source i put into a conflicting product decides what goes back to its set.
template <class T, unsigned Parts>
void share_by_sources(Combined<T, Parts>& out, const Frame& frame, const std::array<Belief<T, Parts>, 2>& m) {
  for (unsigned i = 0; i < 2; ++i)
    for (unsigned x = 0; x < m[i].size(); ++x)
      for (unsigned y = 0; y < m[i].size(); ++y) {
        if (!frame.is_empty(x & y) || m[i][x] == 0 || m[1 - i][y] == 0) continue;
        out.m[x] += T(T(m[i][x] * m[i][x]) * T(m[1 - i][y] / T(m[i][x] + m[1 - i][y])));
      }
}

/// Every product on an empty set goes to the union of the two sets; where that is empty too, to the union of the
/// hypotheses they are made of (DSmH; Dubois & Prade's rule never gets there).
template <class T, unsigned Parts>
void conflict_to_unions(Combined<T, Parts>& out, const Frame& frame, const Belief<T, Parts>& m1,
                        const Belief<T, Parts>& m2) {
  for (unsigned x = 0; x < m1.size(); ++x)
    for (unsigned y = 0; y < m2.size(); ++y) {
      if (!frame.is_empty(x & y) || m1[x] == 0 || m2[y] == 0) continue;
      unsigned to = x | y;
      if (frame.is_empty(to))
        for (unsigned h : frame.hypotheses)
          if ((h & to) != 0) to |= h;
      out.m[to] += T(m1[x] * m2[y]);
    }
}

/// Denœux's cautious rule by its definition: weights w(A) = product over B ⊇ A of q(B)^±1 from the commonalities q, the
/// lesser weight of each proper non-empty subset, their simple supports combined conjunctively and divided by the sum.
/// A belief that leaves no ignorance has no weights: it is taken with 2^-4096 of ignorance.
template <class T, unsigned Parts>
Combined<T, Parts> cautious(const Frame& frame, const std::array<Belief<T, Parts>, 2>& m) {
  const unsigned all = (1U << Parts) - 1, possible = all & ~frame.impossible;
  T next_to_nothing = T(1) / T(2);
  for (int i = 0; i < 12; ++i) next_to_nothing *= next_to_nothing;
  const auto commonality = [&](const Belief<T, Parts>& b, unsigned a) {
    T q(0);
    for (unsigned x = 0; x < b.size(); ++x)
      if ((x & a) == a) q += b[x];
    return b[all] == 0 ? T(q + next_to_nothing) : q;
  };
  const auto size = [](unsigned a) { return __builtin_popcount(a); };
  Combined<T, Parts> out;
  out.m[all] = T(1);
  for (unsigned a = 1; a < possible; ++a) {
    if ((a & ~possible) != 0) continue;
    std::array<T, 2> weight{T(1), T(1)};
    for (unsigned s = 0; s < 2; ++s)
      for (unsigned b = 1; b <= possible; ++b) {
        if ((b & ~possible) != 0 || (b & a) != a) continue;
        const T q = commonality(m[s], b);
        if ((size(b) - size(a)) % 2 == 1) {
          weight[s] *= q;
        } else {
          weight[s] /= q;
        }
      }
    const T w = std::min(weight[0], weight[1]);
    Belief<T, Parts> simple{};
    simple[a | frame.impossible] = T(1) - w;
    simple[all] = w;
    out = conjunctive<T, Parts>(frame, out.m, simple);
  }
  return out;
}

/// Pignistic probability of a hypothesis.
template <class T, unsigned Parts>
T pignistic(const Frame& frame, const Belief<T, Parts>& m, unsigned h) {
  const unsigned possible = ((1U << Parts) - 1) & ~frame.impossible;
  T p(0);
  for (unsigned x = 1; x < m.size(); ++x)
    if ((x & possible) != 0)
      p += T(m[x] * T(T(__builtin_popcount(x & h & possible)) / T(__builtin_popcount(x & possible))));
  return p;
}

/// Bayes on the pignistic probabilities, prior equal; equal again, as total conflict, when nothing is left.
template <class T, unsigned Parts>
Combined<T, Parts> bayes(const Frame& frame, const Belief<T, Parts>& m1, const Belief<T, Parts>& m2) {
  Combined<T, Parts> out;
  for (unsigned h : frame.hypotheses) out.m[h] = pignistic<T, Parts>(frame, m1, h) * pignistic<T, Parts>(frame, m2, h);
  if (!divide_by_sum<T, Parts>(out.m)) {
    for (unsigned h : frame.hypotheses) out.m[h] = T(1) / T(static_cast<unsigned>(frame.hypotheses.size()));
    out.total_conflict = true;
  }
  return out;
}

/// Fuzzy union of each hypothesis's memberships: 1 − product of the complements. Ignorance: none of them; the paradox,
/// under `both`: all of them.
template <class T, unsigned Parts>
Combined<T, Parts> fuzzy(const Frame& frame, const Belief<T, Parts>& m1, const Belief<T, Parts>& m2, unsigned both) {
  Combined<T, Parts> out;
  T none(1), every(1);
  for (unsigned h : frame.hypotheses) {
    const T outside = T(T(1) - m1[h]) * T(T(1) - m2[h]);
    out.m[h] = T(1) - outside;
    none *= outside;
    every *= out.m[h];
  }
  out.m.back() = none;
  out.m[both] = every;
  return out;
}

/// Dempster's rule. `least`: the sum below which it answers with ignorance.
template <class T, unsigned Parts>
Combined<T, Parts> dempster(const Frame& frame, const Belief<T, Parts>& m1, const Belief<T, Parts>& m2,
                            const T& least) {
  Combined<T, Parts> out = conjunctive<T, Parts>(frame, m1, m2);
  if (!divide_by_sum<T, Parts>(out.m, least)) {
    out.m.fill(T(0));
    out.m.back() = T(1);
    out.total_conflict = true;
  }
  return out;
}

/// One combination by `rule`, divided by its own sum where it is of masses; what a rule leaves on the empty set or the
/// paradox lies under frame.impossible. `least`: what counts as nothing for Dempster's sum and PCR4's masses.
template <class T, unsigned Parts>
Combined<T, Parts> combine(evigrid::Rule rule, const Frame& frame, const Belief<T, Parts>& first,
                           const Belief<T, Parts>& second, const T& least = T(0)) {
  using evigrid::Rule;
  const auto closed = [&](const Belief<T, Parts>& m) {
    switch (rule) {
      case Rule::conjunctive:
      case Rule::dsmc:
      case Rule::dsmh:
      case Rule::germ_pcr2:
      case Rule::fuzzy:
        return m;
      case Rule::pcr1:
      case Rule::pcr2:
      case Rule::pcr3:
      case Rule::pcr4:
      case Rule::pcr5:
      case Rule::pcr6:
      case Rule::pcr5plus:
      case Rule::pcr6plus:
        return give_back_empty<T, Parts>(frame, m);
      default:
        return drop_empty<T, Parts>(frame, m);
    }
  };
  const Belief<T, Parts> m1 = closed(first), m2 = closed(second);
  Combined<T, Parts> out;
  switch (rule) {
    case Rule::dempster:
    case Rule::dempster_log:
      return dempster<T, Parts>(frame, m1, m2, least);
    case Rule::yager:
      out = conjunctive<T, Parts>(frame, m1, m2);
      out.m.back() += out.conflict;
      break;
    case Rule::dubois_prade:
      out = conjunctive<T, Parts>(frame, m1, m2);
      conflict_to_unions<T, Parts>(out, frame, m1, m2);
      break;
    case Rule::dsmh:
      out = conjunctive<T, Parts>(frame, m1, m2);
      conflict_to_unions<T, Parts>(out, frame, m1, m2);
      break;
    case Rule::germ_pcr2:
      out = conjunctive<T, Parts>(frame, m1, m2);
      share_by_columns<T, Parts>(out, m1, m2, exclusive<T, Parts>(frame));
      break;
    case Rule::pcr1:
    case Rule::pcr2:
    case Rule::pcr3:
    case Rule::pcr4:
    case Rule::pcr5:
    case Rule::pcr6:
    case Rule::pcr5plus:
    case Rule::pcr6plus:
      out = conjunctive<T, Parts>(frame, m1, m2);
      if (rule == Rule::pcr1) share_by_all_columns<T, Parts>(out, m1, m2);
      if (rule == Rule::pcr2) share_by_columns<T, Parts>(out, m1, m2, involved<T, Parts>(frame, m1, m2));
      if (rule == Rule::pcr3) share_by_pairs<T, Parts>(out, frame, m1, m2, false, least);
      if (rule == Rule::pcr4) share_by_pairs<T, Parts>(out, frame, m1, m2, true, least);
      if (rule == Rule::pcr5 || rule == Rule::pcr5plus) share_by_products<T, Parts>(out, frame, m1, m2);
      if (rule == Rule::pcr6 || rule == Rule::pcr6plus) share_by_sources<T, Parts>(out, frame, {m1, m2});
      break;
    case Rule::conjunctive:  // open world: the empty set is a set like any other
      out = conjunctive<T, Parts>(frame, m1, m2);
      out.m[frame.impossible] += out.conflict;
      out.conflict = out.made;
      break;
    case Rule::dsmc:  // free model: nothing is impossible
      out = conjunctive<T, Parts>({frame.hypotheses, 0}, m1, m2);
      out.conflict = conjunctive<T, Parts>(frame, m1, m2).made;
      break;
    case Rule::disjunctive:
      for (unsigned x = 0; x < m1.size(); ++x)
        for (unsigned y = 0; y < m1.size(); ++y) out.m[x | y] += T(m1[x] * m2[y]);
      out.conflict = conjunctive<T, Parts>(frame, m1, m2).conflict;
      break;
    case Rule::murphy: {
      Belief<T, Parts> mean;
      for (unsigned x = 0; x < mean.size(); ++x) mean[x] = T(m1[x] + m2[x]) / T(2);
      out = dempster<T, Parts>(frame, mean, mean, least);
      out.conflict = conjunctive<T, Parts>(frame, m1, m2).conflict;
      return out;
    }
    case Rule::cautious:
      out = cautious<T, Parts>(frame, {m1, m2});
      out.conflict = conjunctive<T, Parts>(frame, m1, m2).conflict;
      break;
    case Rule::bayes:
      out = bayes<T, Parts>(frame, m1, m2);
      out.conflict = conjunctive<T, Parts>(frame, m1, m2).conflict;
      return out;
    case Rule::fuzzy:
      out = fuzzy<T, Parts>(frame, m1, m2, frame.impossible);
      out.conflict = conjunctive<T, Parts>(frame, m1, m2).made;
      return out;
  }
  divide_by_sum<T, Parts>(out.m);
  return out;
}

}  // namespace oracle
