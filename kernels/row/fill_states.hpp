// SPDX-License-Identifier: Apache-2.0
// A target's rules whose state in a map is not (e, o, u). Included by exactly one file per target.
#pragma once
#include "kernels/cell/state_sums.hpp"
#include "kernels/row/rule_table.hpp"

EVIGRID_CELL_BEGIN

void fill_states(KernelTable& t) {
  fill_state<OpenCells>(t, kConjunctive);
  fill_state<LargerWeights>(t, kCautious);
  fill_state<MeanCells>(t, kMurphy);
  fill_state<LogOdds>(t, kBayes);
  fill_pair<LogOdds, ModelProbability>(t, kBayes, kProbability);
  fill_state<Memberships>(t, kFuzzy);
  fill_pair<Memberships, ModelFuzzy>(t, kFuzzy, kFuzzyModel);
  fill_pair<Memberships, ModelMoravec1985>(t, kFuzzy, kMoravec1985);
  fill_state<LogWeights>(t, kDempsterLog);
}

EVIGRID_CELL_END
