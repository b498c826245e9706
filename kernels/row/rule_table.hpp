// SPDX-License-Identifier: Apache-2.0
// One rule's column of a target's table. What two files of one target both expand is the same text compiled in the same
// way, so it does not matter whose copy the linker keeps.
#pragma once

#include "kernels/cell/mass.hpp"
#include "kernels/cell/model_fuzzy.hpp"
#include "kernels/cell/model_hughes1992.hpp"
#include "kernels/cell/model_li2006.hpp"
#include "kernels/cell/model_li2014.hpp"
#include "kernels/cell/model_moravec1985.hpp"
#include "kernels/cell/model_oriolo1997.hpp"
#include "kernels/cell/model_probability.hpp"
#include "kernels/cell/polar.hpp"
#include "kernels/cell/poly.hpp"
#include "kernels/row/fuse_cone.hpp"
#include "kernels/row/fuse_fan.hpp"
#include "kernels/row/measure_cone.hpp"
#include "kernels/row/read_out.hpp"
#include "kernels/row/tables.hpp"

EVIGRID_CELL_BEGIN

/// One allowed pair; the others stay null (engine/src/model_rows.cpp refuses them by name).
template <class State, class Model>
void fill_pair(KernelTable& t, int rule, ConeModel model) {
  t.fuse_cone[rule][model] = fuse_cone<State, Model>;
  t.measure_cone[rule][model] = measure_cone<paradox_of<State>(), Model>;
  t.combine_measured[rule][model] = combine_measured<State, SourceOf<paradox_of<State>(), Model>>;
}

/// The models that may hold mass on empty ∩ occupied.
template <class State>
void fill_paradox_models(KernelTable& t, int rule) {
  fill_pair<State, ModelLi2014>(t, rule, kLi2014);
  fill_pair<State, ModelLi2006>(t, rule, kLi2006);
}

/// A state's part of the column: the models of masses, and fans.
template <class State>
void fill_state(KernelTable& t, int rule) {
  fill_pair<State, ModelHughes1992>(t, rule, kHughes1992);
  fill_pair<State, ModelOriolo1997>(t, rule, kOriolo1997);
  fill_paradox_models<State>(t, rule);
  t.fuse_fan[rule] = fuse_fan<State>;
  t.read_out[rule] = read_out<State>;
}

template <class Rule>
void fill_rule(KernelTable& t, int rule) {
  fill_state<MassCells<Rule>>(t, rule);
}

/// A rule that is another one (already filled in) for every source without mass on empty ∩ occupied.
template <class Rule>
void fill_paradox_rule(KernelTable& t, int rule, int otherwise) {
  for (int model = 0; model < kConeModels; ++model) {
    t.fuse_cone[rule][model] = t.fuse_cone[otherwise][model];
    t.measure_cone[rule][model] = t.measure_cone[otherwise][model];
    t.combine_measured[rule][model] = t.combine_measured[otherwise][model];
  }
  fill_paradox_models<MassCells<Rule>>(t, rule);
  t.fuse_fan[rule] = t.fuse_fan[otherwise];
  t.read_out[rule] = t.read_out[otherwise];
}

EVIGRID_CELL_END
