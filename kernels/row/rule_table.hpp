// SPDX-License-Identifier: Apache-2.0
// One rule's column of a target's table. What two files of one target both expand is the same text compiled in the same
// way, so it does not matter whose copy the linker keeps.
#pragma once

#include "kernels/cell/mass.hpp"
#include "kernels/cell/model_hughes1992.hpp"
#include "kernels/cell/model_li2014.hpp"
#include "kernels/cell/polar.hpp"
#include "kernels/cell/poly.hpp"
#include "kernels/row/dense.hpp"
#include "kernels/row/fuse_cone.hpp"
#include "kernels/row/fuse_fan.hpp"
#include "kernels/row/measure_cone.hpp"
#include "kernels/row/tables.hpp"

EVIGRID_CELL_BEGIN

template <class Rule>
void fill_rule(KernelTable& t, int rule) {
  t.fuse_cone[rule][0] = fuse_cone<Rule, ModelHughes1992>;
  t.fuse_cone[rule][1] = fuse_cone<Rule, ModelLi2014>;
  t.fuse_fan[rule] = fuse_fan<Rule>;
  t.measure_cone[rule][0] = measure_cone<paradox_of<Rule>(), ModelHughes1992>;
  t.measure_cone[rule][1] = measure_cone<paradox_of<Rule>(), ModelLi2014>;
  t.combine_measured[rule][0] = combine_measured<Rule, ModelHughes1992>;
  t.combine_measured[rule][1] = combine_measured<Rule, ModelLi2014>;
  t.dense[rule] = dense<Rule>;
}

/// A rule that is another one (already filled in) for every source without mass on empty ∩ occupied.
template <class Rule>
void fill_paradox_rule(KernelTable& t, int rule, int otherwise) {
  t.fuse_cone[rule][0] = t.fuse_cone[otherwise][0];
  t.fuse_cone[rule][1] = fuse_cone<Rule, ModelLi2014>;
  t.fuse_fan[rule] = t.fuse_fan[otherwise];
  t.measure_cone[rule][0] = t.measure_cone[otherwise][0];
  t.measure_cone[rule][1] = measure_cone<paradox_of<Rule>(), ModelLi2014>;
  t.combine_measured[rule][0] = t.combine_measured[otherwise][0];
  t.combine_measured[rule][1] = combine_measured<Rule, ModelLi2014>;
  t.dense[rule] = t.dense[otherwise];
}

EVIGRID_CELL_END
