// SPDX-License-Identifier: Apache-2.0
// The batched combination on arrays of the device: memory is the bound, so a thread takes four pairs a block apart and
// the loads of a warp are lines.
#include "kernels/device/cuda_dense.hpp"

#include "kernels/device/lane_device.hpp"
// After the lanes.
#include "kernels/device/dense_table.hpp"

EVIGRID_CELL_BEGIN

constexpr unsigned kThreads = 256, kPairs = 4;

template <class Rule>
__global__ void __launch_bounds__(kThreads)
    dense_pairs(const DensePlanes p, std::size_t n, unsigned long long* totals) {
  const std::size_t first = static_cast<std::size_t>(blockIdx.x) * (kThreads * kPairs) + threadIdx.x;
  unsigned total = 0;
#pragma unroll
  for (unsigned i = 0; i < kPairs; ++i) {
    if (const std::size_t at = first + i * kThreads; at < n) total += dense_cell<Rule>(p, at);
  }
  if constexpr (Rule::kTotalPossible) {
    total = __reduce_add_sync(0xffffffffu, total);
    if (threadIdx.x % 32 == 0 && total > 0) atomicAdd(totals, static_cast<unsigned long long>(total));
  }
}

using Dense = void (*)(const DensePlanes&, std::size_t, unsigned long long*, cudaStream_t);
template <class Rule>
void launch_dense(const DensePlanes& p, std::size_t n, unsigned long long* totals, cudaStream_t stream) {
  const std::size_t per_block = kThreads * kPairs;
  dense_pairs<Rule><<<static_cast<unsigned>((n + per_block - 1) / per_block), kThreads, 0, stream>>>(p, n, totals);
}

void dense_on_device(int rule, const DensePlanes& p, std::size_t n, unsigned long long* totals, cudaStream_t stream) {
  static const DenseTable<Dense> table = [] {
    DenseTable<Dense> t;
    fill_dense_rules(t, []<class Rule>(Of<Rule>) -> Dense { return launch_dense<Rule>; });
    return t;
  }();
  if (n > 0) table.cell[rule](p, n, totals, stream);
}

EVIGRID_CELL_END
