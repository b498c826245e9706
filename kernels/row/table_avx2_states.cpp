// SPDX-License-Identifier: Apache-2.0
// Rules of the avx2 table whose state is not (e, o, u).
#include "kernels/row/target_avx2.hpp"
// After the target.
#include "kernels/row/fill_states.hpp"
