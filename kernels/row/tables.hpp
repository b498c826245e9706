// SPDX-License-Identifier: Apache-2.0
// The tables that are compiled in; select.cpp asks the processor which may run.
#pragma once
#include "kernels/row/kernel_table.hpp"

namespace evigrid::kernels {
const KernelTable& avx2_table() noexcept;
const KernelTable& avx512_table() noexcept;
}  // namespace evigrid::kernels
