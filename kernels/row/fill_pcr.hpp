// SPDX-License-Identifier: Apache-2.0
// A target's PCR2, PCR5 and GERM-PCR2. Included by exactly one file per target.
#pragma once
#include "kernels/cell/rule_pcr.hpp"
#include "kernels/row/rule_table.hpp"

EVIGRID_CELL_BEGIN

void fill_pcr(KernelTable& t) {
  fill_rule<Pcr2>(t, kPcr2);
  fill_rule<Pcr5>(t, kPcr5);
  fill_paradox_rule<GermPcr2>(t, kGermPcr2, kPcr2);
}

EVIGRID_CELL_END
