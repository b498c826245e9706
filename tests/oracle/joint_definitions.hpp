// SPDX-License-Identifier: Apache-2.0
// Joint rules on the frame of a cell as their authors define them: a sum over all tuples of focal sets, one of each
// source, by sets of Venn parts (set_algebra.hpp); nothing closed-form. Runs on any number type.
#pragma once
#include <set>

#include "evigrid/types.hpp"
#include "tests/oracle/set_algebra.hpp"

namespace oracle {

/// One tuple: the set and the mass that each source names.
template <class T>
struct Tuple {
  std::vector<unsigned> set;
  std::vector<T> mass;
  T product = T(1);
};

template <class T, unsigned Parts, class Body>
void over_tuples(const std::vector<Belief<T, Parts>>& sources, const Body& body) {
  std::vector<std::vector<unsigned>> focal(sources.size());
  for (std::size_t s = 0; s < sources.size(); ++s)
    for (unsigned x = 0; x < sources[s].size(); ++x)
      if (sources[s][x] != 0) focal[s].push_back(x);
  std::vector<std::size_t> at(sources.size(), 0);
  for (;;) {  // an odometer over all focal sets of all sources
    Tuple<T> tuple;
    for (std::size_t s = 0; s < sources.size(); ++s) {
      const unsigned x = focal[s][at[s]];
      tuple.set.push_back(x);
      tuple.mass.push_back(sources[s][x]);
      tuple.product *= sources[s][x];
    }
    body(tuple);
    std::size_t s = 0;
    while (s < at.size() && ++at[s] == focal[s].size()) at[s++] = 0;
    if (s == at.size()) return;
  }
}

template <class T, unsigned Parts>
Combined<T, Parts> combine_joint(evigrid::Rule rule, const Frame& frame, std::vector<Belief<T, Parts>> sources) {
  using evigrid::Rule;
  const bool gives_back = rule != Rule::yager && rule != Rule::dubois_prade && rule != Rule::dsmh;
  for (Belief<T, Parts>& m : sources) {
    if (gives_back) m = give_back_empty<T, Parts>(frame, m);
    if (rule == Rule::yager || rule == Rule::dubois_prade) m = drop_empty<T, Parts>(frame, m);
  }
  Belief<T, Parts> column{}, conjunctive{};
  for (const auto& m : sources)
    for (unsigned x = 0; x < m.size(); ++x) column[x] += m[x];
  const auto intersection = [](const Tuple<T>& t) {
    unsigned all = ~0U;
    for (unsigned x : t.set) all &= x;
    return all;
  };
  Combined<T, Parts> out;
  over_tuples<T, Parts>(sources, [&](const Tuple<T>& t) {
    const unsigned x = intersection(t);
    if (frame.is_empty(x)) {
      out.conflict += t.product;
    } else {
      conjunctive[x] += t.product;
    }
  });
  out.m = conjunctive;

  /// `amount` to the sets by their weights; ignorance where there is none.
  const auto share = [&](const T& amount, const std::set<unsigned>& sets, const auto& weight) {
    T sum(0);
    for (unsigned x : sets) sum += weight(x);
    if (sum == 0) return void(out.m.back() += amount);
    for (unsigned x : sets) out.m[x] += T(amount * T(weight(x) / sum));
  };
  const auto sets_of = [](const Tuple<T>& t) { return std::set<unsigned>(t.set.begin(), t.set.end()); };
  const auto without_ignorance = [](std::set<unsigned> sets) {
    sets.erase((1U << Parts) - 1);
    return sets;
  };
  const auto by_column = [&](unsigned x) { return column[x]; };
  const auto by_conjunctive = [&](unsigned x) { return conjunctive[x]; };

  if (rule == Rule::pcr1) {
    std::set<unsigned> all;
    for (unsigned x = 1; x < column.size(); ++x)
      if (column[x] != 0) all.insert(x);
    if (out.conflict != 0) share(out.conflict, all, by_column);
  }
  if (rule == Rule::pcr2) {
    std::set<unsigned> involved;
    over_tuples<T, Parts>(sources, [&](const Tuple<T>& t) {
      if (frame.is_empty(intersection(t))) involved.merge(without_ignorance(sets_of(t)));
    });
    if (out.conflict != 0) share(out.conflict, involved, by_column);
  }
  over_tuples<T, Parts>(sources, [&](const Tuple<T>& t) {
    if (!frame.is_empty(intersection(t))) return;
    const auto sets = sets_of(t);
    switch (rule) {
      case Rule::yager:
        out.m.back() += t.product;
        break;
      case Rule::dubois_prade:
      case Rule::dsmh: {
        unsigned all = 0;
        for (unsigned x : sets) all |= x;
        if (frame.is_empty(all))
          for (unsigned h : frame.hypotheses)
            if ((h & all) != 0) all |= h;
        out.m[all] += t.product;
        break;
      }
      case Rule::pcr3:
        share(t.product, without_ignorance(sets), by_column);
        break;
      case Rule::pcr4: {
        const auto some = without_ignorance(sets);
        bool zero = false;
        for (unsigned x : some) zero = zero || conjunctive[x] == 0;
        zero ? share(t.product, some, by_column) : share(t.product, some, by_conjunctive);
        break;
      }
      case Rule::pcr5:
      case Rule::pcr5plus:
        share(t.product, rule == Rule::pcr5 ? sets : without_ignorance(sets), [&](unsigned x) {
          T put(1);
          for (std::size_t s = 0; s < t.set.size(); ++s)
            if (t.set[s] == x) put *= t.mass[s];
          return put;
        });
        break;
      case Rule::pcr6:
      case Rule::pcr6plus: {  // source by source, as Martin & Osswald print it
        T sum(0);
        const unsigned ignorance = (1U << Parts) - 1;
        const auto counts = [&](std::size_t s) { return rule == Rule::pcr6 || t.set[s] != ignorance; };
        for (std::size_t s = 0; s < t.set.size(); ++s)
          if (counts(s)) sum += t.mass[s];
        for (std::size_t s = 0; s < t.set.size(); ++s)
          if (counts(s)) out.m[t.set[s]] += T(t.product * T(t.mass[s] / sum));
        break;
      }
      default:
        break;
    }
  });
  divide_by_sum<T, Parts>(out.m);
  return out;
}

}  // namespace oracle
