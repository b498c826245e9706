// SPDX-License-Identifier: Apache-2.0
// What makes a file one of the avx512 target's. The target is set for that file's own functions only (pragma, not a
// compiler flag), so that no inline function of the standard library is ever compiled for it and merged into the
// baseline program. Included first.
#pragma once
#include <bit>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "hwy/detect_targets.h"
#undef HWY_TARGET
#define HWY_TARGET HWY_AVX3
#define EVIGRID_BATCH_NAMESPACE avx512_batch
#define EVIGRID_LAMBDA HWY_ATTR
#ifdef EVIGRID_BATCH
#define EVIGRID_TARGET_NAMESPACE EVIGRID_BATCH_NAMESPACE
#include "kernels/cell/lane_vector.hpp"
#else
#define EVIGRID_TARGET_NAMESPACE avx512
#define EVIGRID_TARGET_UNROLL 4
#include "kernels/cell/lane_highway.hpp"
#endif
