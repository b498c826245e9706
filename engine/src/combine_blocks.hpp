// SPDX-License-Identifier: Apache-2.0
// What the batch calls share: the table asked for, blocks of cells over an executor, and one pair of sources on one
// range of cells.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "evigrid/combine.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid {

inline constexpr std::size_t kCombineBlock = std::size_t{1} << 16;  // cells: 1.5 MB of traffic, far above a task's cost

/// Throws std::invalid_argument when it cannot run here.
const kernels::KernelTable& table_of(Kernel);

/// Cells [begin, end) of the call in combine.hpp.
std::uint64_t combine_range(const kernels::KernelTable&, Rule, Planes<const float> a, Planes<const float> b,
                            Planes<float> c, float* conflict, std::size_t begin, std::size_t end);
std::uint64_t combine_range(Rule, Planes<const double> a, Planes<const double> b, Planes<double> c, double* conflict,
                            std::size_t begin, std::size_t end);

/// body(begin, end) over [0, n) in blocks; returns the sum of its results.
template <class Body>
std::uint64_t over_blocks(std::size_t n, Executor* executor, const Body& body) {
  if (executor == nullptr || n <= kCombineBlock) return n == 0 ? 0 : body(0, n);
  struct Context {
    const Body& body;
    std::size_t n;
    std::atomic<std::uint64_t> sum{0};
  } context{body, n};
  executor->run(
      static_cast<std::int64_t>((n + kCombineBlock - 1) / kCombineBlock),
      [](void* p, std::int64_t index, int) {
        auto& c = *static_cast<Context*>(p);
        const std::size_t begin = static_cast<std::size_t>(index) * kCombineBlock;
        c.sum += c.body(begin, std::min(begin + kCombineBlock, c.n));
      },
      &context);
  return context.sum;
}

}  // namespace evigrid
