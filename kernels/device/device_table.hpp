// SPDX-License-Identifier: Apache-2.0
// Which launch serves a rule and a model, in maps that forget and in others. Included after `LaunchArgs`,
// `launch_cones<State, Model, kForgets>` and `launch_fans<State, kForgets>` of a device or its emulation.
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
struct Launches {
  Launch that_keep = nullptr, that_forget = nullptr;
};
struct DeviceTable {
  Launches cones[kRules][kConeModels] = {};
  Launches fans[kRules] = {};
  /// model: −1 for fans.
  [[nodiscard]] Launch of(int rule, int model, bool forgets) const {
    const Launches& l = model < 0 ? fans[rule] : cones[rule][model];
    return forgets ? l.that_forget : l.that_keep;
  }
};

template <class State, class Model>
Launches cone_launches() {
  Launches l{launch_cones<State, Model, false>};
  if constexpr (kCanForget<State>) l.that_forget = launch_cones<State, Model, true>;
  return l;
}
template <class State>
Launches fan_launches() {
  Launches l{launch_fans<State, false>};
  if constexpr (kCanForget<State>) l.that_forget = launch_fans<State, true>;
  return l;
}

template <class State>
void fill_paradox_models(DeviceTable& t, int rule) {
  t.cones[rule][kLi2014] = cone_launches<State, ModelLi2014>();
  t.cones[rule][kLi2006] = cone_launches<State, ModelLi2006>();
}
template <class State>
void fill_state(DeviceTable& t, int rule) {
  t.cones[rule][kHughes1992] = cone_launches<State, ModelHughes1992>();
  t.cones[rule][kOriolo1997] = cone_launches<State, ModelOriolo1997>();
  fill_paradox_models<State>(t, rule);
  t.fans[rule] = fan_launches<State>();
}
/// A rule that is another one (already filled in) for every source without mass on empty ∩ occupied.
template <class Rule>
void fill_paradox_rule(DeviceTable& t, int rule, int otherwise) {
  for (int model = 0; model < kConeModels; ++model) t.cones[rule][model] = t.cones[otherwise][model];
  fill_paradox_models<MassCells<Rule>>(t, rule);
  t.fans[rule] = t.fans[otherwise];
}

// Templates, so that a file has the kernels of those groups alone that it calls for.
template <class Table>
void fill_dempster_and_yager_here(Table& t) {
  fill_state<MassCells<Dempster>>(t, kDempster);
  fill_state<MassCells<Yager>>(t, kYager);
  fill_paradox_rule<Dsmh>(t, kDsmh, kYager);
}
template <class Table>
void fill_pcr_here(Table& t) {
  fill_state<MassCells<Pcr2>>(t, kPcr2);
  fill_state<MassCells<Pcr5>>(t, kPcr5);
  fill_paradox_rule<GermPcr2>(t, kGermPcr2, kPcr2);
}
template <class Table>
void fill_pcr14_here(Table& t) {
  fill_state<MassCells<Pcr1>>(t, kPcr1);
  fill_state<MassCells<Pcr4>>(t, kPcr4);
}
template <class Table>
void fill_states_here(Table& t) {
  fill_state<OpenCells>(t, kConjunctive);
  fill_state<LargerWeights>(t, kCautious);
  fill_state<MeanCells>(t, kMurphy);
  fill_state<LogOdds>(t, kBayes);
  t.cones[kBayes][kProbability] = cone_launches<LogOdds, ModelProbability>();
  fill_state<Memberships>(t, kFuzzy);
  t.cones[kFuzzy][kFuzzyModel] = cone_launches<Memberships, ModelFuzzy>();
  t.cones[kFuzzy][kMoravec1985] = cone_launches<Memberships, ModelMoravec1985>();
  fill_state<LogWeights>(t, kDempsterLog);
}

EVIGRID_CELL_END
