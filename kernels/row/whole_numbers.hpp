// SPDX-License-Identifier: Apache-2.0
// Vectors of whole numbers, which Lanes do not have: the compiler's own, of whatever width the target has.
#pragma once
#include <cstdint>

#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

template <class Number, int kCount>
struct Numbers {
  using type __attribute__((vector_size(sizeof(Number) * kCount))) = Number;
};
using Int8 = Numbers<std::int32_t, 8>::type;
using Int16 = Numbers<std::int32_t, 16>::type;
using Byte16 = Numbers<std::uint8_t, 16>::type;
using Short16 = Numbers<std::int16_t, 16>::type;
using Float16 = Numbers<float, 16>::type;
using Address16 = Numbers<std::uintptr_t, 16>::type;

EVIGRID_CELL_END
