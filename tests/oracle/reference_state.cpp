// SPDX-License-Identifier: Apache-2.0
// dempster_log: Dempster's rule by the set algebra, in long double, whose exponent is wide enough for thousands of
// nats; murphy: the mean's commonalities to the n-th power (Shafer 1976, theorem 3.3: commonalities multiply); bayes:
// odds multiplied; cautious: Denoeux's definition by commonalities, on the cell's masses; conjunctive, dsmc and fuzzy:
// the set algebra.
#include "tests/oracle/reference_state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oracle {
namespace {

using evigrid::Rule;
using Masses = Belief<Long, 3>;

constexpr Long kLeastUnknown = 1e-4L, kLeastMass = 1e-12L, kLeastOpen = 1e-30L, kLeastLikelihood = 1e-6L;

Masses masses_of(const Source& s) {
  Masses m{};
  m[kEmpty] = s.x, m[kOccupied] = s.y, m[kUnknown] = s.v, m[kBoth] = s.z;
  divide_by_sum<Long, 3>(m);
  return m;
}

/// No source of a weight may be certain: it keeps this much of ignorance, in proportion to its masses.
Masses with_ignorance(Masses m) {
  m = drop_empty<Long, 3>(cell_frame(), m);
  m[kUnknown] = std::max(m[kUnknown], kLeastUnknown);
  return m;  // its sum may be 1.0001: every use divides
}

/// What a state of whole multiples of 2^-23 has no place for: half a unit and less, of a weight or of murphy's masses.
constexpr Long kHalfUnit = 0x1p-24L;
Masses with_weights_kept(Masses m) {
  for (unsigned x : {kEmpty, kOccupied})
    if (std::log1p(m[x] / m[kUnknown]) <= kHalfUnit) m[x] = 0;
  return m;
}

double floored(Long x, Long least) { return static_cast<double>(x < least ? 0 : x); }
StateAnswer answer(const Masses& m, Long conflict, Long least = kLeastMass) {
  return {floored(m[kEmpty], least), floored(m[kOccupied], least), std::max(static_cast<double>(m[kUnknown]), 1e-30),
          floored(m[kBoth], least), static_cast<double>(conflict)};
}

Long product_conflict(const Masses& a, const Masses& b) { return a[kEmpty] * b[kOccupied] + a[kOccupied] * b[kEmpty]; }

Masses to_the_power(const Masses& mean, Long n) {
  const Long u = std::max(mean[kUnknown], kLeastUnknown), e = std::pow(mean[kEmpty] + u, n),
             o = std::pow(mean[kOccupied] + u, n), both = std::pow(u, n);
  Masses out{};
  out[kEmpty] = e - both, out[kOccupied] = o - both, out[kUnknown] = both;
  divide_by_sum<Long, 3>(out);
  return out;
}

}  // namespace

std::optional<StateAnswer> update_state(const evigrid::MapParams& p, StateNumbers& s, const Source& source) {
  const Frame& frame = cell_frame();
  if (!s.told) s.m[kUnknown] = p.rule == Rule::murphy ? 0 : 1, s.told = true;
  const Masses open = masses_of(source), closed = drop_empty<Long, 3>(frame, open);
  switch (p.rule) {
    case Rule::dempster_log: {
      const Long k = product_conflict(s.m, closed);
      s.m = combine<Long, 3>(Rule::dempster, frame, s.m, with_weights_kept(with_ignorance(open))).m;
      return answer(s.m, k);
    }
    case Rule::cautious: {
      const Long k = product_conflict(s.m, closed);
      s.m = cautious<Long, 3>(frame, {s.m, with_ignorance(open)}).m;
      divide_by_sum<Long, 3>(s.m);
      return answer(s.m, k);
    }
    case Rule::murphy: {
      Masses mean = s.m;
      divide_by_sum<Long, 3>(mean);
      const Long k = s.readings == 0 ? 0 : product_conflict(mean, closed);
      s.readings += 1;
      Masses kept = closed;
      for (unsigned x : {kEmpty, kOccupied})
        if (kept[x] <= kHalfUnit) kept[kUnknown] += std::exchange(kept[x], 0);
      for (unsigned x = 0; x < mean.size(); ++x) s.m[x] += kept[x], mean[x] = s.m[x] / s.readings;
      return answer(to_the_power(mean, s.readings), k);
    }
    case Rule::bayes: {
      const auto probability = [](Long odds) { return odds / (1 + odds); };
      const Long before = probability(s.odds);
      const Long k = s.odds == 1 ? 0 : (1 - before) * closed[kOccupied] + before * closed[kEmpty];
      const Long share = p.bayes.likelihood == evigrid::Likelihood::plp ? 1 : 0.5L;
      const Long occupied = closed[kOccupied] + share * closed[kUnknown],
                 empty = closed[kEmpty] + share * closed[kUnknown];
      // At least a millionth of the less likely, and as much more of the other as they differ.
      const Long less = std::max(std::min(occupied, empty), kLeastLikelihood), gap = occupied - empty;
      s.odds *= gap > 0 ? (less + gap) / less : less / (less - gap);
      const auto odds = [](Long q) { return q / (1 - q); };
      s.odds = std::clamp(s.odds, odds(p.bayes.least_p), odds(p.bayes.most_p));
      if (s.odds == 1) return StateAnswer{0, 0, 1, 0, static_cast<double>(k)};
      const auto after = static_cast<double>(probability(s.odds));
      return StateAnswer{1 - after, after, 0, 0, static_cast<double>(k)};
    }
    case Rule::fuzzy: {
      const Masses before = s.m;
      Masses taken = open;
      if (source.yields) taken[kOccupied] *= (1 - before[kEmpty]) * (1 - open[kEmpty]);  // O(1 − Emp), after E
      const Masses joined = fuzzy<Long, 3>(frame, s.m, taken, kBoth).m;
      s.m[kEmpty] = joined[kEmpty], s.m[kOccupied] = joined[kOccupied];
      return StateAnswer{floored(joined[kEmpty], kLeastMass), floored(joined[kOccupied], kLeastMass),
                         static_cast<double>(joined[kUnknown]), static_cast<double>(joined[kBoth]),
                         static_cast<double>(product_conflict(before, open))};
    }
    case Rule::conjunctive:
    case Rule::dsmc: {
      const Long k = product_conflict(s.m, open);
      s.m = combine<Long, 3>(p.rule, frame, s.m, open).m;
      return answer(s.m, k, kLeastOpen);
    }
    default:
      return std::nullopt;
  }
}

}  // namespace oracle
