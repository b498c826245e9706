// SPDX-License-Identifier: Apache-2.0
// Which beam and which class a cell centre has, decided exactly in double (products of lattice numbers are exact
// there). The SIMD kernels ask it only for the few cells that are too near a border to be sure in float.
#pragma once
#include "kernels/row/reading.hpp"

namespace evigrid::kernels {

/// 0 = no update, 1 = empty, 2 = occupied. `candidate` is within one beam of the truth.
int fan_class_exact(const FanReading&, float dx, float dy, int candidate);

/// Lanes named by `bits`: their classes, from offsets and beams (as floats), into `cls`.
void decide_exactly(const FanReading&, std::uint64_t bits, const float* dx, const float* dy, const float* beam,
                    float* cls);

}  // namespace evigrid::kernels
