// SPDX-License-Identifier: Apache-2.0
#include "capsules.hpp"
// The target is set for this file's own functions only (pragma, not a compiler flag).
#include "hwy/detect_targets.h"
#undef HWY_TARGET
#define HWY_TARGET HWY_AVX2
#define EVIGRID_TARGET_NAMESPACE avx2
#include "capsules_kernel.hpp"

namespace evigrid::raycast {
const CapsuleKernel& avx2_capsule_kernel() {
  static const CapsuleKernel kernel{"avx2", avx2::capsules, avx2::squares};
  return kernel;
}
}  // namespace evigrid::raycast
