// SPDX-License-Identifier: Apache-2.0
#include "evigrid/raycast/noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace evigrid::raycast {
namespace {

TEST(Noise, IsAFunctionOfItsKey) {
  const NoiseKey key{1, 2, 3, 4};
  const double first = gaussian(key);
  (void)gaussian({9, 9, 9, 9});
  EXPECT_EQ(gaussian(key), first);
  EXPECT_EQ(noisy(2, {0, 0}, key), 2);
  EXPECT_EQ(noisy(2, {0.01, 0.005}, key), 2 + (0.01 + 0.005 * 2) * first);
}

TEST(Noise, BitsArePinned) {
  // The same on every machine and for ever: a change here changes every simulated run.
  EXPECT_EQ(random_bits({0, 0, 0, 0}, 0), 2391539541053276776u);
  EXPECT_EQ(random_bits({42, 1, 23, 999}, 5), 36394161615270815u);
  EXPECT_EQ(gaussian({42, 1, 23, 999}), -0x1.518afa728p+1);
}

TEST(Noise, EveryPartOfTheKeyCounts) {
  std::set<std::uint64_t> bits;
  for (std::uint64_t seed = 0; seed < 6; ++seed)
    for (std::uint32_t robot = 0; robot < 6; ++robot)
      for (std::uint32_t sensor = 0; sensor < 6; ++sensor)
        for (std::uint64_t cycle = 0; cycle < 6; ++cycle)
          for (std::uint32_t draw = 0; draw < 6; ++draw) bits.insert(random_bits({seed, robot, sensor, cycle}, draw));
  EXPECT_EQ(bits.size(), 6u * 6 * 6 * 6 * 6);
}

TEST(Noise, MomentsAndTailsOfANormal) {
  const int n = 200000;
  double sum = 0, square = 0, fourth = 0, neighbours = 0, last = 0;
  int beyond_2 = 0;
  for (int i = 0; i < n; ++i) {
    const double g = gaussian({7, 0, static_cast<std::uint32_t>(i % 24), static_cast<std::uint64_t>(i / 24)});
    ASSERT_LE(std::abs(g), 6);
    sum += g;
    square += g * g;
    fourth += g * g * g * g;
    neighbours += g * last;
    beyond_2 += std::abs(g) > 2;
    last = g;
  }
  EXPECT_NEAR(sum / n, 0, 0.01);
  EXPECT_NEAR(square / n, 1, 0.02);
  EXPECT_NEAR(fourth / n, 2.9, 0.05);  // 3 − 1.2/12, the price of twelve uniforms
  EXPECT_NEAR(neighbours / n, 0, 0.01);
  EXPECT_NEAR(static_cast<double>(beyond_2) / n, 0.0455, 0.003);
}

}  // namespace
}  // namespace evigrid::raycast
