// SPDX-License-Identifier: Apache-2.0
// The avx2 table: models, Dempster, Yager, DSmH and the rules of the batch.
#include "kernels/row/target_avx2.hpp"
// After the target.
#include "kernels/row/table.hpp"

namespace evigrid::kernels {
const KernelTable& avx2_table() noexcept {
  static const KernelTable table = avx2::make_table("avx2", 8);
  return table;
}
}  // namespace evigrid::kernels
