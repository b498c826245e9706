// SPDX-License-Identifier: Apache-2.0
// The arrays, and which kernels this processor can run.
#include "capsules.hpp"

#include "hwy/targets.h"

namespace evigrid::raycast {

void Capsules::resize(std::size_t count) {
  for (auto* component : {&x0, &y0, &x1, &y1, &radius}) component->assign(count + kSpare, 0);
  name.assign(count + kSpare, 0);
}

void Capsules::set(std::size_t at, Vec2 a, Vec2 b, double radius_m, std::uint32_t n) {
  x0[at] = static_cast<float>(a.x), y0[at] = static_cast<float>(a.y);
  x1[at] = static_cast<float>(b.x), y1[at] = static_cast<float>(b.y);
  radius[at] = static_cast<float>(radius_m);
  name[at] = n;
}

void Proposals::make_room(std::size_t count) {
  if (name.size() >= count + kSpare) return;
  nearest_m.resize(2 * count + kSpare);
  name.resize(2 * count + kSpare);
}

const CapsuleKernel* find_capsule_kernel(std::string_view target) {
  static const auto supported = hwy::SupportedTargets();
  if (target == "scalar") return &scalar_capsule_kernel();
  if (target == "avx2" && (supported & HWY_AVX2) != 0) return &avx2_capsule_kernel();
  if (target == "avx512" && (supported & HWY_AVX3) != 0) return &avx512_capsule_kernel();
  return nullptr;
}

const CapsuleKernel& capsule_kernel() {
  static const CapsuleKernel& best = []() -> const CapsuleKernel& {
    for (const char* target : {"avx512", "avx2"})
      if (const CapsuleKernel* kernel = find_capsule_kernel(target)) return *kernel;
    return scalar_capsule_kernel();
  }();
  return best;
}

}  // namespace evigrid::raycast
