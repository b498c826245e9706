// SPDX-License-Identifier: Apache-2.0
// The exponential and the logarithm of the states, over the floats of their domain: every float with
// EVIGRID_EVERY_FLOAT=1, else one in 61.
#define EVIGRID_LAMBDA
#include "kernels/cell/lane_scalar.hpp"
// After the target.
#include "kernels/cell/poly.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace evigrid::kernels {
namespace {

std::uint32_t stride() { return std::getenv("EVIGRID_EVERY_FLOAT") != nullptr ? 1 : 61; }

/// f(x) for the floats in (0, most].
template <class F>
void each_float(float most, F&& f) {
  const auto last = std::bit_cast<std::uint32_t>(most), step = stride();
  for (std::uint32_t bits = 0x00800000u; bits <= last; bits += step) f(std::bit_cast<float>(bits));
}

TEST(Polynomials, Exponential) {
  double value = 0, less_one = 0;
  each_float(80, [&](float x) {
    const auto r = scalar::exponential(-x);
    const double want = std::exp(-static_cast<double>(x));
    value = std::max(value, std::fabs(r.value / want - 1));
    less_one = std::max(less_one, std::fabs(r.less_one / std::expm1(-static_cast<double>(x)) - 1));
  });
  const auto zero = scalar::exponential(0.0f);
  EXPECT_EQ(zero.value, 1);
  EXPECT_EQ(zero.less_one, 0);
  RecordProperty("value", std::to_string(value * 1e9));
  std::printf("e^x: relative error %.3g, e^x - 1: %.3g\n", value, less_one);
  EXPECT_LE(value, 1.1e-7);
  EXPECT_LE(less_one, 2.6e-7);
}

TEST(Polynomials, LogOnePlus) {
  double relative = 0, parts = 0, largest_small = 0;
  each_float(1e6f, [&](float x) {
    const auto p = scalar::log_one_plus_parts(x);
    const double want = std::log1p(static_cast<double>(x));
    relative = std::max(relative, std::fabs(scalar::log_one_plus(x) / want - 1));
    parts = std::max(parts, std::fabs(static_cast<double>(p.large) + p.small - want));
    largest_small = std::max(largest_small, std::fabs(static_cast<double>(p.small)));
  });
  EXPECT_EQ(scalar::log_one_plus(0.0f), 0);
  std::printf("ln(1 + x): relative error %.3g, of two parts absolute %.3g\n", relative, parts);
  EXPECT_LE(relative, 1.7e-7);
  EXPECT_LE(parts, 5e-8);
  EXPECT_LT(largest_small, 0.5);
}

}  // namespace
}  // namespace evigrid::kernels
