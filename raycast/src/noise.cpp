// SPDX-License-Identifier: Apache-2.0
// Mixing: the SplitMix64 finaliser (Steele, Lea, Flood 2014), applied once per word of the key, each word spread by its
// own odd constant so that (robot 1, sensor 0) and (robot 0, sensor 1) part at once.
#include "evigrid/raycast/noise.hpp"

namespace evigrid::raycast {
namespace {

std::uint64_t mix(std::uint64_t z) noexcept {
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace

std::uint64_t random_bits(const NoiseKey& key, std::uint32_t draw) noexcept {
  std::uint64_t h = mix(key.seed);
  h = mix(h ^ (std::uint64_t{key.robot} << 32 | key.sensor));
  h = mix(h ^ key.cycle);
  return mix(h ^ draw * 0xd1342543de82ef95u);
}

double gaussian(const NoiseKey& key, std::uint32_t index) noexcept {
  // Two uniforms of 32 bits per draw. The sum is an integer below 2^36: exact, so its order cannot matter.
  std::uint64_t sum = 0;
  for (std::uint32_t draw = 0; draw < 6; ++draw) {
    const std::uint64_t bits = random_bits(key, 6 * index + draw);
    sum += (bits >> 32) + (bits & 0xffffffffu);
  }
  // + 6: each uniform is taken at the middle of its step, which makes the mean exactly 0.
  return static_cast<double>(sum + 6) * 0x1p-32 - 6;
}

double noisy(double range_m, const RangeNoise& noise, const NoiseKey& key, std::uint32_t index) noexcept {
  return range_m + (noise.sigma_m + noise.ratio * range_m) * gaussian(key, index);
}

}  // namespace evigrid::raycast
