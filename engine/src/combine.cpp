// SPDX-License-Identifier: Apache-2.0
// The batched combination of two sources: blocks of cells over the executor, each block one call of the chosen table.
#include "evigrid/combine.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "combine_blocks.hpp"
#include "device/device_combine.hpp"
#include "kernels/row/kernel_table.hpp"
#include "rule_kernels.hpp"

namespace evigrid {
namespace {

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

const kernels::KernelTable& table_of(Kernel kernel) {
  if (!kernel_available(kernel))
    throw std::invalid_argument("kernel: " + std::string(name(kernel)) + " cannot run here");
  // Beside a device the processor does what is not the device's: compiling, binning, reading out.
  const kernels::KernelTable* table = kernels::find_table(name(kernel == Kernel::cuda ? Kernel::automatic : kernel));
  return *table;
}

std::uint64_t combine_range(const kernels::KernelTable& table, Rule rule, Planes<const float> a, Planes<const float> b,
                            Planes<float> c, float* conflict, std::size_t begin, std::size_t end) {
  if (a.c != nullptr || b.c != nullptr) return through_double(rule, a, b, c, conflict, begin, end);
  const kernels::DensePlanes planes{a.e, a.o, a.u, b.e, b.o, b.u, c.e, c.o, c.u, conflict, c.c};
  const std::uint64_t totals = table.dense[kernel_of(rule)](planes, begin, end);
  if (c.c != nullptr && !keeps_paradox(rule)) std::fill(c.c + begin, c.c + end, 0.0f);
  return totals;
}

std::uint64_t combine_range(Rule rule, Planes<const double> a, Planes<const double> b, Planes<double> c,
                            double* conflict, std::size_t begin, std::size_t end) {
  const kernels::DoublePlanes planes{a.e, a.o, a.u, a.c, b.e, b.o, b.u, b.c, c.e, c.o, c.u, c.c, conflict};
  const std::uint64_t totals = kernels::dense_double(kernel_of(rule), planes, begin, end);
  if (c.c != nullptr && !keeps_paradox(rule)) std::fill(c.c + begin, c.c + end, 0.0);
  return totals;
}

std::uint64_t combine(Rule rule, Planes<const float> a, Planes<const float> b, Planes<float> c, float* conflict,
                      std::size_t n, Kernel kernel, Executor* executor) {
  const kernels::KernelTable& table = table_of(kernel);
  if (kernel == Kernel::cuda && a.c == nullptr && b.c == nullptr) return combine_by_device(rule, a, b, c, conflict, n);
  return over_blocks(n, executor, [&](std::size_t begin, std::size_t end) {
    return combine_range(table, rule, a, b, c, conflict, begin, end);
  });
}

std::uint64_t combine(Rule rule, Planes<const double> a, Planes<const double> b, Planes<double> c, double* conflict,
                      std::size_t n, Executor* executor) {
  return over_blocks(n, executor, [&](std::size_t begin, std::size_t end) {
    return combine_range(rule, a, b, c, conflict, begin, end);
  });
}

std::string_view resolve_kernel_name(Kernel kernel) {
  return kernel == Kernel::cuda ? name(kernel) : table_of(kernel).name;
}
bool kernel_available(Kernel kernel) noexcept {
  return kernel == Kernel::cuda ? kernels::why_no_cuda().empty() : kernels::find_table(name(kernel)) != nullptr;
}
std::string why_no_cuda() { return kernels::why_no_cuda(); }

double fuzzy_map(double empty, double occupied) noexcept {
  const double not_occupied = 1 - occupied, both = empty * occupied, neither = (1 - empty) * not_occupied;
  return 1 - empty * empty * not_occupied * (1 - both) * (1 - neither);
}

}  // namespace evigrid
