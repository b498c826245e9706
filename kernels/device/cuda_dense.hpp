// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cuda_runtime.h>

#include "kernels/row/kernel_table.hpp"

namespace evigrid::kernels::device {
/// Arrays of the device; adds the total conflicts to *totals, of the device too.
void dense_on_device(int rule, const DensePlanes&, std::size_t n, unsigned long long* totals, cudaStream_t);
}  // namespace evigrid::kernels::device
