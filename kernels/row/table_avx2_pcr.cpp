// SPDX-License-Identifier: Apache-2.0
// PCR2, PCR5 and GERM-PCR2 of the avx2 table.
#include "kernels/row/target_avx2.hpp"
// After the target.
#include "kernels/row/fill_pcr.hpp"
