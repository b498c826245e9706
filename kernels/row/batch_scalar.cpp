// SPDX-License-Identifier: Apache-2.0
// The batched combination of the scalar table.
#define EVIGRID_LAMBDA
#include "kernels/cell/lane_scalar.hpp"
// After the target.
#include "kernels/row/batch.hpp"
