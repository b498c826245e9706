// SPDX-License-Identifier: Apache-2.0
// A target's PCR1 and PCR4. Included by exactly one file per target.
#pragma once
#include "kernels/cell/rule_pcr14.hpp"
#include "kernels/row/rule_table.hpp"

EVIGRID_CELL_BEGIN

void fill_pcr14(KernelTable& t) {
  fill_rule<Pcr1>(t, kPcr1);
  fill_rule<Pcr4>(t, kPcr4);
}

EVIGRID_CELL_END
