// SPDX-License-Identifier: Apache-2.0
#include "device/device_combine.hpp"

#include <algorithm>
#include <mutex>

#include "rule_kernels.hpp"

namespace evigrid {

std::uint64_t combine_by_device(kernels::Device& device, Rule rule, Planes<const float> a, Planes<const float> b,
                                Planes<float> c, float* conflict, std::size_t n) {
  const kernels::DensePlanes planes{a.e, a.o, a.u, b.e, b.o, b.u, c.e, c.o, c.u, conflict, c.c};
  const std::uint64_t totals = device.combine(kernel_of(rule), planes, n);
  if (c.c != nullptr && !keeps_paradox(rule)) std::fill_n(c.c, n, 0.0f);
  return totals;
}

std::uint64_t combine_by_device(Rule rule, Planes<const float> a, Planes<const float> b, Planes<float> c,
                                float* conflict, std::size_t n) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  static const std::unique_ptr<kernels::Device> device = kernels::make_cuda_device();  // 0.2 s: once
  return combine_by_device(*device, rule, a, b, c, conflict, n);
}

}  // namespace evigrid
