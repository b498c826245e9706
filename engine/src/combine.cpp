// SPDX-License-Identifier: Apache-2.0
// The batched combination: blocks of cells over the executor, each block one call of the chosen table.
#include "evigrid/combine.hpp"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>

#include "kernels/row/kernel_table.hpp"

namespace evigrid {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 16;  // cells: 1.5 MB of traffic, far above the cost of a task

const kernels::KernelTable& table_of(Kernel kernel) {
  const kernels::KernelTable* table = kernels::find_table(name(kernel));
  if (table == nullptr) {
    throw std::invalid_argument("kernel: " + std::string(name(kernel)) + " cannot run on this processor");
  }
  return *table;
}

/// body(begin, end) over [0, n) in blocks; returns the sum of its results.
template <class Body>
std::uint64_t over_blocks(std::size_t n, Executor* executor, const Body& body) {
  if (executor == nullptr || n <= kBlock) return n == 0 ? 0 : body(0, n);
  struct Context {
    const Body& body;
    std::size_t n;
    std::atomic<std::uint64_t> sum{0};
  } context{body, n};
  executor->run(
      static_cast<std::int64_t>((n + kBlock - 1) / kBlock),
      [](void* p, std::int64_t index, int) {
        auto& c = *static_cast<Context*>(p);
        const std::size_t begin = static_cast<std::size_t>(index) * kBlock;
        c.sum += c.body(begin, std::min(begin + kBlock, c.n));
      },
      &context);
  return context.sum;
}

}  // namespace

std::uint64_t combine(Rule rule, Planes<const float> a, Planes<const float> b, Planes<float> c, float* conflict,
                      std::size_t n, Kernel kernel, Executor* executor) {
  const auto dense = table_of(kernel).dense[static_cast<int>(rule)];
  const kernels::DensePlanes planes{a.e, a.o, a.u, b.e, b.o, b.u, c.e, c.o, c.u, conflict};
  return over_blocks(n, executor, [&](std::size_t begin, std::size_t end) { return dense(planes, begin, end); });
}

std::uint64_t combine(Rule rule, Planes<const double> a, Planes<const double> b, Planes<double> c, double* conflict,
                      std::size_t n, Executor* executor) {
  const double* const pa[3] = {a.e, a.o, a.u};
  const double* const pb[3] = {b.e, b.o, b.u};
  double* const pc[3] = {c.e, c.o, c.u};
  return over_blocks(n, executor, [&](std::size_t begin, std::size_t end) {
    return kernels::dense_double(static_cast<int>(rule), pa, pb, pc, conflict, begin, end);
  });
}

std::string_view resolve_kernel_name(Kernel kernel) { return table_of(kernel).name; }
bool kernel_available(Kernel kernel) noexcept { return kernels::find_table(name(kernel)) != nullptr; }

}  // namespace evigrid
