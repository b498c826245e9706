// SPDX-License-Identifier: Apache-2.0
// Costs of micro-tiles beside each other, as bytes in four rows: what a planner asks for every cycle. Of masses without
// c; the same operations in the same order as engine/src/grid/costs.cpp has for one cell, so the same bytes.
#pragma once
#include <cstring>

#include "kernels/row/whole_numbers.hpp"

EVIGRID_CELL_BEGIN

inline void render_costs(const CostArgs& args, const float* cells, int planes, int micros, std::uint8_t* out,
                         std::ptrdiff_t stride) {
  static_assert(kMicroCells == 16 && kMicroSide == 4);
  const CostArgs c = args;  // a copy: the bytes written might be anything
  const auto step = static_cast<std::ptrdiff_t>(planes) * kMicroCells, below = step * kMicrosPerSide;
  const auto none = static_cast<std::int32_t>(c.none), lethal = static_cast<std::int32_t>(c.lethal);
  const Int16 zero = {};
  for (int m = 0; m < micros; ++m, cells += step, out += kMicroSide) {
    Float16 o, u;
    std::memcpy(&o, cells + kMicroCells, sizeof o);
    std::memcpy(&u, cells + 2 * kMicroCells, sizeof u);
    // What was fused a moment ago lies in memory by now: the next row of micro-tiles is asked for.
    __builtin_prefetch(cells + below + kMicroCells);
    __builtin_prefetch(cells + below + 2 * kMicroCells);
    const Float16 betp = o + 0.5f * u;
    Int16 cost = __builtin_convertvector((betp - c.free_below) * c.slope + 1.5f, Int16);
    cost = betp < c.free_below ? zero : cost;
    cost = betp > c.lethal_above ? zero + lethal : cost;
    cost = u > c.max_unknown ? zero + none : cost;
    const Byte16 bytes = __builtin_convertvector(__builtin_convertvector(cost, Short16), Byte16);  // gcc: by steps
    for (int row = 0; row < kMicroSide; ++row)
      std::memcpy(out + row * stride, reinterpret_cast<const char*>(&bytes) + row * kMicroSide, kMicroSide);
  }
}

EVIGRID_CELL_END
