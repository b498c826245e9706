// SPDX-License-Identifier: Apache-2.0
// Which tables this processor can run, and what suits it.
#include "hwy/targets.h"
#include "kernels/row/fetch_ahead.hpp"
#include "kernels/row/tables.hpp"

namespace evigrid::kernels {

#ifdef EVIGRID_NO_SIMD  // EVIGRID_SIMD=OFF, or another family of processors
const KernelTable* find_table(std::string_view name) noexcept {
  return name == "scalar" || name == "auto" ? &scalar_table() : nullptr;
}
#else
const KernelTable* find_table(std::string_view name) noexcept {
  static const auto supported = hwy::SupportedTargets();  // asks the processor: 20 µs in a virtual machine
  const bool avx2 = (supported & HWY_AVX2) != 0, avx512 = (supported & HWY_AVX3) != 0;
  if (name == "scalar") return &scalar_table();
  if (name == "avx2") return avx2 ? &avx2_table() : nullptr;
  if (name == "avx512") return avx512 ? &avx512_table() : nullptr;
  if (name == "auto") return avx512 ? &avx512_table() : avx2 ? &avx2_table() : &scalar_table();
  return nullptr;
}
#endif

bool fetches_ahead() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  static const bool intel = __builtin_cpu_is("intel");
  return intel;
#else
  return false;
#endif
}

}  // namespace evigrid::kernels
