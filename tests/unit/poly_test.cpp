// SPDX-License-Identifier: Apache-2.0
// The polynomials over the floats of their domain: every float with EVIGRID_EXHAUSTIVE=1, else one in 61 (the angle
// alone takes minutes then). 2^y is in tests/oracle/model_error_test.cpp, beside the masses it makes.
#define EVIGRID_LAMBDA
#include "kernels/cell/lane_scalar.hpp"
// After the target.
#include "kernels/cell/poly.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/exhaustive.hpp"

namespace evigrid::kernels {
namespace {

std::uint32_t stride() { return tests::exhaustive() ? 1 : 61; }

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

/// The mass that the exponent makes, 2^(−l²): where the exponent is large its error does not count.
TEST(Polynomials, LogarithmOfThePowerOfLi2014) {
  const double scale = std::sqrt(80 / std::log(2.0));
  double mass = 0;
  const auto look = [&](float t) {
    const double got = scalar::scaled_log(t), want = scale * std::log(static_cast<double>(t) + 1.1);
    mass = std::max(mass, std::fabs(std::exp2(-got * got) - std::exp2(-want * want)));
  };
  each_float(0.516f, look);
  each_float(0.463f, [&](float t) { look(-t); });
  look(0);
  std::printf("scaled logarithm: largest error of the mass %.3g\n", mass);
  EXPECT_LE(mass, 5e-7);
}

/// Every quotient of a direction's coordinates, in each of the eight octants.
TEST(Polynomials, CoarseAngle) {
  double most = 0;
  each_float(1.0f, [&](float z) {
    for (int octant = 0; octant < 8; ++octant) {
      float x = (octant & 1) != 0 ? z : 1.0f, y = (octant & 1) != 0 ? 1.0f : z;
      if ((octant & 2) != 0) x = -x;
      if ((octant & 4) != 0) y = -y;
      most = std::max(
          most, std::fabs(scalar::coarse_angle(x, y) - std::atan2(static_cast<double>(y), static_cast<double>(x))));
    }
  });
  std::printf("coarse angle: largest error %.3g rad\n", most);
  EXPECT_LE(most, 5.2e-7);  // over every float 5.19e-7; candidates are looked for 2.5e-6 about (compile_fan.hpp)
}

}  // namespace
}  // namespace evigrid::kernels
