// SPDX-License-Identifier: Apache-2.0
// The batched combination of a device: one pair a thread, the rules of kernels/row/batch.hpp.
#pragma once
#include "kernels/cell/rule_batch.hpp"
#include "kernels/cell/rule_dempster.hpp"
#include "kernels/cell/rule_pcr.hpp"
#include "kernels/cell/rule_pcr14.hpp"
#include "kernels/cell/rule_yager.hpp"
#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

/// Pair i; answers 1 for total conflict. Both operands are read before C is written: C may be A or B.
template <class Rule>
EVIGRID_FN unsigned dense_cell(const DensePlanes& p, std::size_t i) {
  const Cell<float> a{p.ae[i], p.ao[i], p.au[i]};
  const PlainSource<float> b{p.be[i], p.bo[i], p.bu[i]};
  const auto r = Rule::template combine<Exact>(a, b);
  p.ce[i] = r.cell.a;
  p.co[i] = r.cell.b;
  p.cu[i] = r.cell.u;
  if (p.k != nullptr) p.k[i] = r.k;
  if constexpr (requires { r.c; }) {
    if (p.cc != nullptr) p.cc[i] = r.c;
  }
  if constexpr (Rule::kTotalPossible) {
    return r.total ? 1u : 0u;
  } else {
    return 0u;
  }
}

template <class Rule>
struct Of {};
template <class Function>
struct DenseTable {
  Function cell[kBatchRules] = {};
};
/// of(Of<Rule>) gives the function that serves a rule.
template <class Table, class F>
void fill_dense_rules(Table& t, F of) {
  t.cell[kDempster] = t.cell[kDempsterLog] = of(Of<Dempster>());
  t.cell[kYager] = t.cell[kDsmh] = of(Of<Yager>());
  t.cell[kPcr2] = t.cell[kGermPcr2] = of(Of<Pcr2>());
  t.cell[kPcr5] = of(Of<Pcr5>());
  t.cell[kPcr1] = of(Of<Pcr1>());
  t.cell[kPcr4] = of(Of<Pcr4>());
  t.cell[kConjunctive] = of(Of<ConjunctiveRule>());
  t.cell[kDisjunctive] = of(Of<Disjunctive>());
  t.cell[kMurphy] = of(Of<Murphy>());
  t.cell[kCautious] = of(Of<Cautious>());
  t.cell[kBayes] = of(Of<Bayes>());
  t.cell[kFuzzy] = of(Of<Fuzzy>());
}

EVIGRID_CELL_END
