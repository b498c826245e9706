// SPDX-License-Identifier: Apache-2.0
// A target's batched combination, every rule, and the bands of a cone. The lanes are one micro-tile wide here, not
// four: a rule is a short chain and its 64 cells in flight spilled registers, whereas the processor interleaves the
// steps of a plain loop by itself. A namespace of its own keeps these lanes apart from the map's. Included by exactly
// one file per target.
#pragma once
#include "kernels/cell/rule_batch.hpp"
#include "kernels/cell/rule_dempster.hpp"
#include "kernels/cell/rule_pcr.hpp"
#include "kernels/cell/rule_pcr14.hpp"
#include "kernels/cell/rule_yager.hpp"
#include "kernels/row/cone_bands.hpp"
#include "kernels/row/dense.hpp"
#include "kernels/row/tables.hpp"

EVIGRID_CELL_BEGIN

template <class Rule>
void fill_batch_rule(KernelTable& t, int rule) {
  t.dense[rule] = dense<Rule, FloatArrays>;
  t.dense16[rule] = dense<Rule, Unorm16Arrays>;
}

/// A rule that is another one (already filled in) for operands without mass on empty ∩ occupied.
inline void fill_batch_same(KernelTable& t, int rule, int other) {
  t.dense[rule] = t.dense[other];
  t.dense16[rule] = t.dense16[other];
}

void fill_batch(KernelTable& t) {
  t.cone_bands = cone_bands;
  fill_batch_rule<Dempster>(t, kDempster);
  fill_batch_rule<Yager>(t, kYager);
  fill_batch_same(t, kDsmh, kYager);
  fill_batch_rule<Pcr2>(t, kPcr2);
  fill_batch_same(t, kGermPcr2, kPcr2);
  fill_batch_rule<Pcr5>(t, kPcr5);
  fill_batch_rule<Pcr1>(t, kPcr1);
  fill_batch_rule<Pcr4>(t, kPcr4);
  fill_batch_rule<ConjunctiveRule>(t, kConjunctive);
  fill_batch_rule<Disjunctive>(t, kDisjunctive);
  fill_batch_rule<Murphy>(t, kMurphy);
  fill_batch_rule<Cautious>(t, kCautious);
  fill_batch_rule<Bayes>(t, kBayes);
  fill_batch_rule<Fuzzy>(t, kFuzzy);
  fill_batch_same(t, kDempsterLog, kDempster);  // the same for two sources; what differs is the state of a map
}

EVIGRID_CELL_END
