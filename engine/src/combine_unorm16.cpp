// SPDX-License-Identifier: Apache-2.0
// The batched combination of masses at 16 bits, and the way there and back.
#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string>

#include "combine_blocks.hpp"
#include "rule_kernels.hpp"

namespace evigrid {
namespace {
constexpr float kOne = 65535;
std::uint16_t rounded(float mass) {  // as the kernels: adding 2^23 leaves the nearest whole number
  return static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(mass * kOne + 8388608.0f));
}
}  // namespace

std::uint64_t combine(Rule rule, Unorm16Planes<const std::uint16_t> a, Unorm16Planes<const std::uint16_t> b,
                      Unorm16Planes<std::uint16_t> c, float* conflict, std::size_t n, Kernel kernel,
                      Executor* executor) {
  if (kernel_of(rule) == kernels::kConjunctive) {
    throw std::invalid_argument("rule: " + std::string(name(rule)) +
                                " leaves mass on empty and occupied at once, which arrays of 16 bits do not keep");
  }
  const auto dense = table_of(kernel).dense16[kernel_of(rule)];
  const kernels::Dense16Planes planes{a.e, a.o, b.e, b.o, c.e, c.o, conflict};
  return over_blocks(n, executor, [&](std::size_t begin, std::size_t end) { return dense(planes, begin, end); });
}

void to_unorm16(Planes<const float> from, Unorm16Planes<std::uint16_t> to, std::size_t n) noexcept {
  for (std::size_t i = 0; i < n; ++i) {
    to.e[i] = rounded(from.e[i]);
    to.o[i] = rounded(from.o[i]);
  }
}

void from_unorm16(Unorm16Planes<const std::uint16_t> from, Planes<float> to, std::size_t n) noexcept {
  constexpr float kUnit = 1 / kOne;
  for (std::size_t i = 0; i < n; ++i) {
    const float e = from.e[i], o = from.o[i];
    to.e[i] = e * kUnit;
    to.o[i] = o * kUnit;
    to.u[i] = std::max(kOne - (e + o), 0.0f) * kUnit;
  }
}

}  // namespace evigrid
