// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "evigrid/combine.hpp"
#include "kernels/device/device.hpp"

namespace evigrid {

/// As combine() of floats without mass on empty ∩ occupied, by the process's CUDA device. Throws std::runtime_error.
std::uint64_t combine_by_device(Rule, Planes<const float> a, Planes<const float> b, Planes<float> c, float* conflict,
                                std::size_t n);
/// The same by a device at hand.
std::uint64_t combine_by_device(kernels::Device&, Rule, Planes<const float> a, Planes<const float> b, Planes<float> c,
                                float* conflict, std::size_t n);

}  // namespace evigrid
