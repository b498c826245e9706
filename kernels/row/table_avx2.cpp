// SPDX-License-Identifier: Apache-2.0
// The avx2 table. The target is set for this file's own functions only (pragma, not a compiler flag), so that no inline
// function of the standard library is ever compiled for it and merged into the baseline program.
#include <bit>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "hwy/detect_targets.h"
#undef HWY_TARGET
#define HWY_TARGET HWY_AVX2
#define EVIGRID_TARGET_NAMESPACE avx2
#define EVIGRID_TARGET_UNROLL 4
#define EVIGRID_LAMBDA HWY_ATTR
#include "kernels/cell/lane_highway.hpp"
#include "kernels/row/table.hpp"
#include "kernels/row/tables.hpp"

namespace evigrid::kernels {
const KernelTable& avx2_table() noexcept {
  static const KernelTable table = avx2::make_table("avx2", 8);
  return table;
}
}  // namespace evigrid::kernels
