// SPDX-License-Identifier: Apache-2.0
// Which kernel answers a rule: where rules coincide on this frame one kernel serves.
#pragma once
#include "evigrid/types.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid {

kernels::RuleKernel kernel_of(Rule) noexcept;

}  // namespace evigrid
