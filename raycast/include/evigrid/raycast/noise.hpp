// SPDX-License-Identifier: Apache-2.0
// Range noise without state: a number depends only on its key, so the order and the thread of a draw do not matter.
// Integer mixing and sums only, no libm: the same bits on every machine.
#pragma once
#include <cstdint>

#include "evigrid/raycast/export.hpp"

namespace evigrid {
namespace EVIGRID_RAYCAST_API raycast {

struct NoiseKey {
  std::uint64_t seed = 0;
  std::uint32_t robot = 0;
  std::uint32_t sensor = 0;
  std::uint64_t cycle = 0;
};

/// σ(R) = sigma_m + ratio · R.
struct RangeNoise {
  double sigma_m = 0;
  double ratio = 0;
};

/// 64 well mixed bits for the `draw`-th draw of a key.
[[nodiscard]] std::uint64_t random_bits(const NoiseKey& key, std::uint32_t draw) noexcept;

/// About standard normal (sum of 12 uniforms − 6): mean 0, variance 1, never beyond ±6. `index`: the beam of a laser,
/// or whatever else one key has several of.
[[nodiscard]] double gaussian(const NoiseKey& key, std::uint32_t index = 0) noexcept;

/// range_m + σ(range_m) · gaussian(key, index). May leave the sensor's limits; the caller decides what that means.
[[nodiscard]] double noisy(double range_m, const RangeNoise& noise, const NoiseKey& key,
                           std::uint32_t index = 0) noexcept;

}  // namespace raycast
}  // namespace evigrid
