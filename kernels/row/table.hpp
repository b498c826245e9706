// SPDX-License-Identifier: Apache-2.0
// One target's table: every rule × model expanded from the same text, in several files, so that they compile side by
// side: the models and the rules of table_*.cpp here, more groups of rules in table_*_pcr.cpp, table_*_pcr14.cpp and
// table_*_states.cpp (fill_*.hpp). Included last.
#pragma once

#include "kernels/cell/rule_dempster.hpp"
#include "kernels/cell/rule_yager.hpp"
#include "kernels/row/compile_fan.hpp"
#include "kernels/row/list_cone.hpp"
#include "kernels/row/render_costs.hpp"
#include "kernels/row/rule_table.hpp"
#include "kernels/row/select_fan.hpp"

EVIGRID_CELL_BEGIN

inline KernelTable make_table(std::string_view name, int lanes) {
  KernelTable t{};
  t.name = name;
  t.lanes = lanes;
  t.compile_fan = compile_fan;
  t.select_fan = select_fan;
  t.list_cone = list_cone;
  t.render_costs = render_costs;
  fill_rule<Dempster>(t, kDempster);
  fill_rule<Yager>(t, kYager);
  fill_paradox_rule<Dsmh>(t, kDsmh, kYager);
  fill_pcr(t);
  fill_pcr14(t);
  fill_states(t);
  EVIGRID_BATCH_NAMESPACE::fill_batch(t);
  return t;
}

EVIGRID_CELL_END
