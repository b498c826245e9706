// SPDX-License-Identifier: Apache-2.0
// Our own functions against libm (long double), and poses against Eigen.
#include "kernels/row/portable_math.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "evigrid/types.hpp"

namespace evigrid {
namespace {

TEST(PortableMath, AgreesWithLibm) {
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> angle(-100, 100), small(-0.8, 0.8), wide(-20, 20);
  for (int i = 0; i < 200000; ++i) {
    const double a = angle(rng), x = small(rng), y = wide(rng);
    const auto sc = kernels::portable_sincos(a);
    ASSERT_NEAR(sc.sin, static_cast<double>(std::sin(static_cast<long double>(a))), 3e-16);
    ASSERT_NEAR(sc.cos, static_cast<double>(std::cos(static_cast<long double>(a))), 3e-16);
    if (i % 20 == 0) {
      ASSERT_NEAR(kernels::portable_asin(x), std::asin(x), 1e-15);
    }
    ASSERT_NEAR(kernels::portable_exp(y) / std::exp(y), 1, 4e-15);
    ASSERT_NEAR(kernels::portable_tanh(x), std::tanh(x), 1e-15);
  }
}

TEST(Pose, ComposesAsAnIsometry) {
  std::mt19937_64 rng(2);
  std::uniform_real_distribution<double> u(-10, 10);
  for (int i = 0; i < 1000; ++i) {
    const Pose2 a{u(rng), u(rng), u(rng)}, b{u(rng), u(rng), u(rng)};
    const auto iso = [](const Pose2& p) {
      return Eigen::Isometry2d(Eigen::Translation2d(p.x_m, p.y_m) * Eigen::Rotation2Dd(p.yaw_rad));
    };
    const Pose2 c = compose(a, b);
    EXPECT_TRUE((iso(a) * iso(b)).isApprox(iso(c), 1e-12));
  }
}

}  // namespace
}  // namespace evigrid
