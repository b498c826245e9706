// SPDX-License-Identifier: Apache-2.0
#include "capsules.hpp"
// The target is set for this file's own functions only (pragma, not a compiler flag).
#include "hwy/detect_targets.h"
#undef HWY_TARGET
#define HWY_TARGET HWY_SCALAR
#define EVIGRID_TARGET_NAMESPACE scalar
#include "capsules_kernel.hpp"

namespace evigrid::raycast {
const CapsuleKernel& scalar_capsule_kernel() {
  static const CapsuleKernel kernel{"scalar", scalar::capsules, scalar::squares};
  return kernel;
}
}  // namespace evigrid::raycast
