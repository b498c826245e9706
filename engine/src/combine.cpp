// SPDX-License-Identifier: Apache-2.0
// The batched combination: blocks of cells over the executor, each block one call of the chosen table.
#include "evigrid/combine.hpp"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>

#include "kernels/row/kernel_table.hpp"
#include "rule_kernels.hpp"

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

/// Floats with mass on empty ∩ occupied, in double a few at a time.
std::uint64_t through_double(Rule rule, Planes<const float> a, Planes<const float> b, Planes<float> c, float* conflict,
                             std::size_t begin, std::size_t end) {
  constexpr std::size_t kFew = 256;
  double in[8][kFew], out[5][kFew];
  const float* const from[8] = {a.e, a.o, a.u, a.c, b.e, b.o, b.u, b.c};
  float* const to[5] = {c.e, c.o, c.u, c.c, conflict};
  const kernels::DoublePlanes planes{in[0], in[1],  in[2],  in[3],  in[4],  in[5], in[6],
                                     in[7], out[0], out[1], out[2], out[3], out[4]};
  std::fill_n(out[3], kFew, 0.0);
  std::uint64_t totals = 0;
  for (std::size_t at = begin; at < end; at += kFew) {
    const std::size_t n = std::min(kFew, end - at);
    for (std::size_t p = 0; p < 8; ++p) {
      for (std::size_t i = 0; i < n; ++i) in[p][i] = from[p] != nullptr ? from[p][at + i] : 0.0f;
    }
    totals += kernels::dense_double(kernel_of(rule), planes, 0, n);
    for (std::size_t p = 0; p < 5; ++p) {
      for (std::size_t i = 0; i < n && to[p] != nullptr; ++i) to[p][at + i] = static_cast<float>(out[p][i]);
    }
  }
  return totals;
}

}  // namespace

std::uint64_t combine(Rule rule, Planes<const float> a, Planes<const float> b, Planes<float> c, float* conflict,
                      std::size_t n, Kernel kernel, Executor* executor) {
  const auto dense = table_of(kernel).dense[kernel_of(rule)];
  const kernels::DensePlanes planes{a.e, a.o, a.u, b.e, b.o, b.u, c.e, c.o, c.u, conflict, c.c};
  const bool open = a.c != nullptr || b.c != nullptr;
  return over_blocks(n, executor, [&](std::size_t begin, std::size_t end) {
    if (open) return through_double(rule, a, b, c, conflict, begin, end);
    const std::uint64_t totals = dense(planes, begin, end);
    if (c.c != nullptr && !keeps_paradox(rule)) std::fill(c.c + begin, c.c + end, 0.0f);
    return totals;
  });
}

std::uint64_t combine(Rule rule, Planes<const double> a, Planes<const double> b, Planes<double> c, double* conflict,
                      std::size_t n, Executor* executor) {
  const kernels::DoublePlanes planes{a.e, a.o, a.u, a.c, b.e, b.o, b.u, b.c, c.e, c.o, c.u, c.c, conflict};
  return over_blocks(n, executor, [&](std::size_t begin, std::size_t end) {
    const std::uint64_t totals = kernels::dense_double(kernel_of(rule), planes, begin, end);
    if (c.c != nullptr && !keeps_paradox(rule)) std::fill(c.c + begin, c.c + end, 0.0);
    return totals;
  });
}

std::string_view resolve_kernel_name(Kernel kernel) { return table_of(kernel).name; }
bool kernel_available(Kernel kernel) noexcept { return kernels::find_table(name(kernel)) != nullptr; }

double fuzzy_map(double empty, double occupied) noexcept {
  const double not_occupied = 1 - occupied, both = empty * occupied, neither = (1 - empty) * not_occupied;
  return 1 - empty * empty * not_occupied * (1 - both) * (1 - neither);
}

}  // namespace evigrid
