// SPDX-License-Identifier: Apache-2.0
// Which launch serves a rule and a model. Included after `LaunchArgs`, `launch_cones<State, Model>` and
// `launch_fans<State>` of a device or its emulation.
#pragma once
#include "kernels/cell/model_fuzzy.hpp"
#include "kernels/cell/model_hughes1992.hpp"
#include "kernels/cell/model_li2006.hpp"
#include "kernels/cell/model_li2014.hpp"
#include "kernels/cell/model_moravec1985.hpp"
#include "kernels/cell/model_oriolo1997.hpp"
#include "kernels/cell/model_probability.hpp"
#include "kernels/cell/rule_dempster.hpp"
#include "kernels/cell/rule_pcr.hpp"
#include "kernels/cell/rule_pcr14.hpp"
#include "kernels/cell/rule_yager.hpp"
#include "kernels/cell/state.hpp"
#include "kernels/cell/state_sums.hpp"

EVIGRID_CELL_BEGIN

using Launch = void (*)(const LaunchArgs&);
struct DeviceTable {
  Launch cones[kRules][kConeModels] = {};
  Launch fans[kRules] = {};
};

template <class State>
void fill_paradox_models(DeviceTable& t, int rule) {
  t.cones[rule][kLi2014] = launch_cones<State, ModelLi2014>;
  t.cones[rule][kLi2006] = launch_cones<State, ModelLi2006>;
}
template <class State>
void fill_state(DeviceTable& t, int rule) {
  t.cones[rule][kHughes1992] = launch_cones<State, ModelHughes1992>;
  t.cones[rule][kOriolo1997] = launch_cones<State, ModelOriolo1997>;
  fill_paradox_models<State>(t, rule);
  t.fans[rule] = launch_fans<State>;
}
/// A rule that is another one (already filled in) for every source without mass on empty ∩ occupied.
template <class Rule>
void fill_paradox_rule(DeviceTable& t, int rule, int otherwise) {
  for (int model = 0; model < kConeModels; ++model) t.cones[rule][model] = t.cones[otherwise][model];
  fill_paradox_models<MassCells<Rule>>(t, rule);
  t.fans[rule] = t.fans[otherwise];
}

inline void fill_dempster_and_yager_here(DeviceTable& t) {
  fill_state<MassCells<Dempster>>(t, kDempster);
  fill_state<MassCells<Yager>>(t, kYager);
  fill_paradox_rule<Dsmh>(t, kDsmh, kYager);
}
inline void fill_pcr_here(DeviceTable& t) {
  fill_state<MassCells<Pcr2>>(t, kPcr2);
  fill_state<MassCells<Pcr5>>(t, kPcr5);
  fill_paradox_rule<GermPcr2>(t, kGermPcr2, kPcr2);
}
inline void fill_pcr14_here(DeviceTable& t) {
  fill_state<MassCells<Pcr1>>(t, kPcr1);
  fill_state<MassCells<Pcr4>>(t, kPcr4);
}
inline void fill_states_here(DeviceTable& t) {
  fill_state<OpenCells>(t, kConjunctive);
  fill_state<LargerWeights>(t, kCautious);
  fill_state<MeanCells>(t, kMurphy);
  fill_state<LogOdds>(t, kBayes);
  t.cones[kBayes][kProbability] = launch_cones<LogOdds, ModelProbability>;
  fill_state<Memberships>(t, kFuzzy);
  t.cones[kFuzzy][kFuzzyModel] = launch_cones<Memberships, ModelFuzzy>;
  t.cones[kFuzzy][kMoravec1985] = launch_cones<Memberships, ModelMoravec1985>;
  fill_state<LogWeights>(t, kDempsterLog);
}

EVIGRID_CELL_END
