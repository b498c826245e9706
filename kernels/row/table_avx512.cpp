// SPDX-License-Identifier: Apache-2.0
// The avx512 table: models, Dempster, Yager, DSmH and the rules of the batch.
#include "kernels/row/target_avx512.hpp"
// After the target.
#include "kernels/row/table.hpp"

namespace evigrid::kernels {
const KernelTable& avx512_table() noexcept {
  static const KernelTable table = avx512::make_table("avx512", 16);
  return table;
}
}  // namespace evigrid::kernels
