// SPDX-License-Identifier: Apache-2.0
// The batched combination of the avx2 table.
#define EVIGRID_BATCH
#include "kernels/row/target_avx2.hpp"
// After the target.
#include "kernels/row/batch.hpp"
