// SPDX-License-Identifier: Apache-2.0
// The part of a cone reading that its model decides: rings and constants.
#pragma once
#include "kernels/row/compile_reading.hpp"

namespace evigrid::kernels {

/// How far any reading of the sensor can reach; sets its lattice.
double farthest_reach_m(const ConeSpec&) noexcept;
void compile_model(const ConeType&, double range_m, ConeReading&) noexcept;

}  // namespace evigrid::kernels
