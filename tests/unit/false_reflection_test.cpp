// SPDX-License-Identifier: Apache-2.0
// The filter of false reflections (Li et al. 2014): by hand, and against its definition on random rings.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "evigrid/evigrid.hpp"

namespace evigrid {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Report fuse_ring(const std::vector<double>& bearings_deg, const std::vector<float>& ranges_m, double tolerance_m,
                 std::uint64_t* hash = nullptr) {
  Map map({.cell_m = 0.1, .false_reflection_m = tolerance_m}, make_serial_executor());
  std::vector<Reading> readings;
  for (std::size_t i = 0; i < bearings_deg.size(); ++i) {
    Sensor s;
    s.T_robot_sensor.yaw_rad = bearings_deg[i] * kDegree;
    readings.push_back({map.add(s), {&ranges_m[i], 1}});
  }
  const Report r = map.integrate(Scan{0, {}, readings});
  if (hash != nullptr) *hash = map.hash();
  return r;
}
std::uint64_t dropped(const Report& r) { return r.refused[static_cast<std::size_t>(Refusal::false_reflection)]; }

TEST(FalseReflection, TheThirdOfThreeNeighboursIsDropped) {
  // Δ = 0.1; the third leaps by 1.5. It is the only one with two neighbours before it.
  const std::vector<double> at{0, 20, 40};
  EXPECT_EQ(dropped(fuse_ring(at, {2.0F, 2.1F, 3.6F}, 0.1)), 1U);
  EXPECT_EQ(dropped(fuse_ring(at, {2.0F, 2.1F, 2.25F}, 0.1)), 0U);
  EXPECT_EQ(dropped(fuse_ring(at, {2.0F, 2.1F, 2.25F}, 0)), 1U);  // as printed: 0.15 is not below 0.1
  EXPECT_EQ(dropped(fuse_ring(at, {2.0F, 2.1F, 3.6F}, -1)), 0U);  // off
  // Order of declaration does not matter, bearings do.
  EXPECT_EQ(dropped(fuse_ring({40, 0, 20}, {3.6F, 2.0F, 2.1F}, 0.1)), 1U);
}

TEST(FalseReflection, WhoHasNoNeighboursStays) {
  const float none = std::numeric_limits<float>::infinity();
  EXPECT_EQ(dropped(fuse_ring({0, 20}, {2.0F, 4.0F}, 0.1)), 0U);
  EXPECT_EQ(dropped(fuse_ring({0, 20, 90}, {2.0F, 2.1F, 3.6F}, 0.1)), 0U);  // 70 degrees apart
  EXPECT_EQ(dropped(fuse_ring({0, 20, 40}, {none, 2.1F, 3.6F}, 0.1)), 0U);  // no reading to compare with
  EXPECT_EQ(dropped(fuse_ring({0, 20, 40}, {2.0F, 2.1F, none}, 0.1)), 0U);
}

TEST(FalseReflection, RandomRingsByTheDefinition) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::uint64_t all = 0;
  for (int n = 0; n < 200; ++n) {
    const int count = 8 + n % 17;  // 45 to 15 degrees apart: all round
    std::vector<double> at;
    std::vector<float> ranges;
    for (int i = 0; i < count; ++i) {
      at.push_back(-180 + i * 360.0 / count);
      ranges.push_back(static_cast<float>(1 + unit(rng)) + (unit(rng) < 0.2 ? 2.0F : 0.0F));
    }
    std::vector<double> kept_at;
    std::vector<float> kept;
    std::uint64_t want = 0;
    for (int i = 0; i < count; ++i) {
      const float d1 = ranges[static_cast<std::size_t>((i + count - 2) % count)],
                  d2 = ranges[static_cast<std::size_t>((i + count - 1) % count)],
                  d3 = ranges[static_cast<std::size_t>(i)];
      if (std::fabs(static_cast<double>(d3) - d2) < std::fabs(static_cast<double>(d1) - d2) + 0.1) {
        kept_at.push_back(at[static_cast<std::size_t>(i)]), kept.push_back(d3);
      } else {
        ++want;
      }
    }
    std::uint64_t filtered = 0, by_hand = 0;
    const Report r = fuse_ring(at, ranges, 0.1, &filtered);
    fuse_ring(kept_at, kept, -1, &by_hand);
    EXPECT_EQ(dropped(r), want);
    EXPECT_EQ(r.readings_used + want, static_cast<std::uint64_t>(count));
    EXPECT_EQ(filtered, by_hand);  // what is dropped leaves no trace, what stays is fused as ever
    all += want;
  }
  EXPECT_GT(all, 100U);
}

}  // namespace
}  // namespace evigrid
