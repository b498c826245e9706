// SPDX-License-Identifier: Apache-2.0
#include "kernels/row/compile_reading.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/row/compile_cone.hpp"
#include "kernels/row/lattice.hpp"
#include "kernels/row/portable_math.hpp"

namespace evigrid::kernels {
namespace {

/// Cubic through four Chebyshev nodes of [0, width], by Newton's divided differences.
template <class F>
void fit_cubic(F f, double width, float (&out)[4]) {
  constexpr double kNode[4] = {0.03806023374435663, 0.30865828381745513, 0.6913417161825449, 0.9619397662556434};
  double x[4], y[4];
  for (int i = 0; i < 4; ++i) {
    x[i] = kNode[i] * width;
    y[i] = f(x[i]);
  }
  for (int level = 1; level < 4; ++level) {
    for (int i = 3; i >= level; --i) y[i] = (y[i] - y[i - 1]) / (x[i] - x[i - level]);
  }
  double c[4] = {y[3], 0, 0, 0};  // expand from the innermost
  for (int i = 2; i >= 0; --i) {
    for (int k = 3; k >= 1; --k) c[k] = c[k - 1] - x[i] * c[k];
    c[0] = y[i] - x[i] * c[0];
  }
  for (int k = 0; k < 4; ++k) out[k] = static_cast<float>(c[k]);
}

}  // namespace

ConeType::ConeType(const ConeSpec& s) : spec(s) {
  const SinCos whole = portable_sincos(s.aperture_rad);
  aperture_cos = whole.cos, aperture_sin = whole.sin;
  const double alpha = s.aperture_rad / 2, sine = portable_sincos(alpha).sin, sine2 = sine * sine;
  lattice = lattice_steps(farthest_reach_m(s) / s.cell_m);
  fit_cubic(
      [&](double q) {
        const double theta = portable_asin(std::sqrt(sine2 - q));
        return (1 - theta * theta / (alpha * alpha)) / q;
      },
      sine2, lambda);
  const double twice_cosine = 2 * portable_sincos(alpha).cos;
  fit_cubic(
      [&](double w) {
        const double theta = portable_asin(std::sqrt(w) / twice_cosine);
        return theta * theta / (alpha * alpha) / w;
      },
      sine2 * twice_cosine * twice_cosine, off_axis);
  fit_cubic([&](double x2) { return portable_asin(std::sqrt(x2)) / std::sqrt(x2) / (2 * alpha); }, sine2, margin);
  fit_cubic(
      [&](double x) {
        const double g = 1 + s.epsilon_ratio + x / s.rho_i;
        return portable_tanh(x) / x * portable_exp(g * g / (2 * s.rho_e * s.rho_e));
      },
      s.rho_i * s.epsilon_ratio, shell);
}

ConeReading compile_cone(const ConeType& t, const SensorPose& pose, double range_m) noexcept {
  const ConeSpec& s = t.spec;
  ConeReading q;
  place(q, pose, s.cell_m, t.lattice);
  const Direction left = edge_direction(pose.yaw_rad + s.aperture_rad / 2),
                  right = edge_direction(pose.yaw_rad - s.aperture_rad / 2);
  q.lx = left.x, q.ly = left.y, q.rx = right.x, q.ry = right.y;
  q.reliability = static_cast<float>(s.reliability);
  q.doubt = static_cast<float>(1 - s.reliability);
  q.contextual = {s.reliability_if_empty != 1 || s.reliability_if_occupied != 1,
                  static_cast<float>(s.reliability_if_empty), static_cast<float>(s.reliability_if_occupied),
                  static_cast<float>(1 - s.reliability_if_empty), static_cast<float>(1 - s.reliability_if_occupied)};
  compile_model(t, range_m, q);
  return q;
}

}  // namespace evigrid::kernels
