// SPDX-License-Identifier: Apache-2.0
// One target's table: every rule × model expanded from the same text. Included last by table_*.cpp.
#pragma once

#include "kernels/cell/mass.hpp"
#include "kernels/cell/model_hughes1992.hpp"
#include "kernels/cell/model_li2014.hpp"
#include "kernels/cell/polar.hpp"
#include "kernels/cell/poly.hpp"
#include "kernels/cell/rule_dempster.hpp"
#include "kernels/cell/rule_pcr.hpp"
#include "kernels/row/dense.hpp"
#include "kernels/row/fuse_cone.hpp"
#include "kernels/row/fuse_fan.hpp"
#include "kernels/row/select_fan.hpp"

EVIGRID_CELL_BEGIN

template <class Rule>
void fill_rule(KernelTable& t, int rule) {
  t.fuse_cone[rule][0] = fuse_cone<Rule, ModelHughes1992>;
  t.fuse_cone[rule][1] = fuse_cone<Rule, ModelLi2014>;
  t.fuse_fan[rule] = fuse_fan<Rule>;
  t.combine_measured[rule][0] = combine_measured<Rule, ModelHughes1992>;
  t.combine_measured[rule][1] = combine_measured<Rule, ModelLi2014>;
  t.dense[rule] = dense<Rule>;
}

/// Every pointer of the table; the order of rules is that of evigrid::Rule.
inline KernelTable make_table(std::string_view name, int lanes) {
  KernelTable t{};
  t.name = name;
  t.lanes = lanes;
  t.select_fan = select_fan;
  t.measure_cone[0] = measure_cone<ModelHughes1992>;
  t.measure_cone[1] = measure_cone<ModelLi2014>;
  fill_rule<Dempster>(t, 0);
  fill_rule<Pcr2>(t, 1);
  fill_rule<Pcr5>(t, 2);
  fill_rule<GermPcr2>(t, 3);
  return t;
}

EVIGRID_CELL_END
