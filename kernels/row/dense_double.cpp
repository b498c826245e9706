// SPDX-License-Identifier: Apache-2.0
// The batched combination in double: scalar, from the text of the rules; and the only one that takes operands with mass
// on empty ∩ occupied (n of the cell, z of the source): conjunctive and DSmC keep it, DSmH and GERM-PCR2 consume it,
// the PCR family gives it back to empty and occupied, every other rule drops it.
#define EVIGRID_LAMBDA
#include "kernels/cell/lane_scalar.hpp"
// After the target.
#include "kernels/cell/mass.hpp"
#include "kernels/cell/rule_batch.hpp"
#include "kernels/cell/rule_dempster.hpp"
#include "kernels/cell/rule_pcr.hpp"
#include "kernels/cell/rule_pcr14.hpp"
#include "kernels/cell/rule_yager.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid::kernels {
namespace {

using Operand = scalar::Cell<double>;
struct Open {
  Operand m;
  double n;  // on empty ∩ occupied
};

/// In proportion, halves if both are 0.
Operand gave_back(const Open& w) {
  const double p = w.m.a + w.m.b;
  if (p > 0) return {w.m.a + w.n * (w.m.a / p), w.m.b + w.n * (w.m.b / p), w.m.u};
  return {0.5 * w.n, 0.5 * w.n, w.m.u};
}
/// Vacuous when nothing is left; taken as it is when there is nothing to drop.
Operand dropped(const Open& w) {
  if (w.n == 0) return w.m;
  const double s = (w.m.a + w.m.b) + w.m.u;
  return s > 0 ? Operand{w.m.a / s, w.m.b / s, w.m.u / s} : Operand{0, 0, 1};
}
Operand ignored(const Open& w) { return w.m; }

template <class Rule>
auto closed(const Operand& a, const Operand& b) {
  return Rule::template combine<scalar::Exact>(a, scalar::PlainSource<double>{b.a, b.b, b.u});
}

/// A rule that sees closed operands only, once `prepare` has seen to n and z.
template <class Rule, Operand (*prepare)(const Open&)>
struct Closed {
  static constexpr bool kTotalPossible = Rule::kTotalPossible;
  static auto combine(const Open& a, const Open& b) { return closed<Rule>(prepare(a), prepare(b)); }
};

/// Terms of n and z; each is symmetric in the operands.
double paradox(const Open& a, const Open& b) {
  return (a.n * ((b.m.a + b.m.b) + b.m.u) + b.n * ((a.m.a + a.m.b) + a.m.u)) + a.n * b.n;
}
auto conjunctive_part(const Open& a, const Open& b) {
  return scalar::conjunctive(a.m, scalar::PlainSource<double>{b.m.a, b.m.b, b.m.u});
}

struct OpenConjunctive {
  static constexpr bool kTotalPossible = false;
  static scalar::CombinedOpen<double> combine(const Open& a, const Open& b) {
    const auto q = conjunctive_part(a, b);
    const double c = paradox(a, b) + q.k, r = 1 / ((q.e + q.o) + (q.t + c));
    return {{q.e * r, q.o * r, q.t * r}, q.k, c * r};
  }
};

struct OpenDsmh {
  static constexpr bool kTotalPossible = false;
  static scalar::Combined<double> combine(const Open& a, const Open& b) {
    const auto q = conjunctive_part(a, b);
    const double t = ((q.t + (a.m.u * b.n + a.n * b.m.u)) + a.n * b.n) + q.k;
    return {scalar::over_sum(q.e + (a.m.a * b.n + a.n * b.m.a), q.o + (a.m.b * b.n + a.n * b.m.b), t),
            paradox(a, b) + q.k};
  }
};

struct OpenGermPcr2 {
  static constexpr bool kTotalPossible = false;
  static scalar::Combined<double> combine(const Open& a, const Open& b) {
    const auto q = conjunctive_part(a, b);
    return scalar::share_by_columns<scalar::Exact>(a.m, scalar::PlainSource<double>{b.m.a, b.m.b, b.m.u}, q,
                                                   paradox(a, b) + q.k);
  }
};

template <class Rule>
std::uint64_t run(const DoublePlanes& p, std::size_t begin, std::size_t end) {
  std::uint64_t totals = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const Open a{{p.ae[i], p.ao[i], p.au[i]}, p.ac != nullptr ? p.ac[i] : 0};
    const Open b{{p.be[i], p.bo[i], p.bu[i]}, p.bc != nullptr ? p.bc[i] : 0};
    const auto r = Rule::combine(a, b);
    p.ce[i] = r.cell.a;
    p.co[i] = r.cell.b;
    p.cu[i] = r.cell.u;
    if constexpr (requires { r.c; }) {
      if (p.cc != nullptr) p.cc[i] = r.c;
    }
    if (p.k != nullptr) p.k[i] = r.k;
    if constexpr (Rule::kTotalPossible) totals += r.total ? 1 : 0;
  }
  return totals;
}

}  // namespace

std::uint64_t dense_double(int rule, const DoublePlanes& p, std::size_t begin, std::size_t end) {
  switch (static_cast<RuleKernel>(rule)) {
    case kDempster:
    case kDempsterLog:
      return run<Closed<scalar::Dempster, dropped>>(p, begin, end);
    case kPcr2:
      return run<Closed<scalar::Pcr2, gave_back>>(p, begin, end);
    case kPcr5:
      return run<Closed<scalar::Pcr5, gave_back>>(p, begin, end);
    case kGermPcr2:
      return run<OpenGermPcr2>(p, begin, end);
    case kYager:
      return run<Closed<scalar::Yager, dropped>>(p, begin, end);
    case kDsmh:
      return run<OpenDsmh>(p, begin, end);
    case kPcr1:
      return run<Closed<scalar::Pcr1, gave_back>>(p, begin, end);
    case kPcr4:
      return run<Closed<scalar::Pcr4, gave_back>>(p, begin, end);
    case kConjunctive:
      return run<OpenConjunctive>(p, begin, end);
    case kDisjunctive:
      return run<Closed<scalar::Disjunctive, dropped>>(p, begin, end);
    case kMurphy:
      return run<Closed<scalar::Murphy, dropped>>(p, begin, end);
    case kCautious:
      return run<Closed<scalar::Cautious, dropped>>(p, begin, end);
    case kBayes:
      return run<Closed<scalar::Bayes, dropped>>(p, begin, end);
    case kFuzzy:
      return run<Closed<scalar::Fuzzy, ignored>>(p, begin, end);
    case kBatchRules:
      break;
  }
  return 0;
}

}  // namespace evigrid::kernels
