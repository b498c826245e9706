// SPDX-License-Identifier: Apache-2.0
#include "kernels/row/compile_reading.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/row/lattice.hpp"
#include "kernels/row/portable_math.hpp"

namespace evigrid::kernels {
namespace {

constexpr double kLog2E = 1.44269504088896340736;

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

Ring ring(double t) {
  const double t2 = t * t;  // exact: t has at most 22 bits
  const float hi = static_cast<float>(t2);
  return {hi, static_cast<float>(t2 - hi)};
}

/// li2014: where the occupied mass over the empty one, 2^(d²·empty_rate − (d − R)²·occupied_rate), is below 2^-30.4 and
/// the kernel takes it for zero (model_li2014.hpp). The smaller root of the quadratic; negative where there is none.
double li_free_radius(double empty_rate, double occupied_rate, double r) {
  const double a = occupied_rate - empty_rate, b = occupied_rate * r, c = b * r - 30.4;
  const double root = b * b - a * c;
  if (c <= 0 || root <= 0) return -1;
  return c / (b + std::sqrt(root)) - 0.01;
}

/// Half of the angle between the edges as they are, over half of the aperture: on their grid they are off by up to
/// 4e-8 rad each, which a narrow cone's λ would feel in every like reading.
double opening(const ConeType& t, const Direction& left, const Direction& right) {
  const double lx = left.x, ly = left.y, rx = right.x, ry = right.y;
  const double sine = rx * ly - ry * lx, cosine = rx * lx + ry * ly;
  const double more = (sine * t.aperture_cos - cosine * t.aperture_sin) / std::sqrt(sine * sine + cosine * cosine);
  return 1 + more / t.spec.aperture_rad;
}

}  // namespace

ConeType::ConeType(const ConeSpec& s) : spec(s) {
  const SinCos whole = portable_sincos(s.aperture_rad);
  aperture_cos = whole.cos, aperture_sin = whole.sin;
  const double alpha = s.aperture_rad / 2, sine = portable_sincos(alpha).sin, sine2 = sine * sine;
  const double reach = s.model == 0 ? s.max_range_m + s.tolerance_m : s.max_range_m * (1 + 2 * s.epsilon_ratio);
  lattice = lattice_steps(reach / s.cell_m);
  fit_cubic(
      [&](double q) {
        const double theta = portable_asin(std::sqrt(sine2 - q));
        return (1 - theta * theta / (alpha * alpha)) / q;
      },
      sine2, lambda);
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
  const double c = s.cell_m;
  ConeReading q;
  place(q, pose, c, t.lattice);
  const Direction left = edge_direction(pose.yaw_rad + s.aperture_rad / 2),
                  right = edge_direction(pose.yaw_rad - s.aperture_rad / 2);
  q.lx = left.x, q.ly = left.y, q.rx = right.x, q.ry = right.y;
  const double open = opening(t, left, right);
  q.reliability = static_cast<float>(s.reliability);
  q.doubt = static_cast<float>(1 - s.reliability);
  const double r = quantise(range_m / c, t.lattice), metres = r * c;
  double outer, edge, within = -1;
  if (s.model == 0) {
    const double tolerance = quantise(s.tolerance_m / c, t.lattice);
    outer = std::min(r + tolerance, quantise(s.r_max_m / c, t.lattice));
    edge = std::max(r - tolerance, 0.0);
    within = edge;
    q.hughes.slope = static_cast<float>(-c / (2 * s.r_max_m));
    q.hughes.max_occupied = static_cast<float>(s.max_occupied);
    for (int i = 0; i < 4; ++i) q.hughes.margin[i] = static_cast<float>(t.margin[i] / open);
  } else {
    outer = quantise(r * (1 + 2 * s.epsilon_ratio), t.lattice);
    edge = r;
    within = r * (1 + s.epsilon_ratio);
    LiConstants& k = q.li;
    for (int i = 0; i < 4; ++i) k.lambda[i] = static_cast<float>(t.lambda[i] / (open * open));
    std::copy(t.shell, t.shell + 4, k.shell);
    const double root = std::sqrt(metres);
    const double peak = s.rho_e * root * metres / (s.rho_e * root + s.rho_o);  // e^β
    const double empty_rate = c * c * kLog2E / (2 * metres * s.rho_e * metres * s.rho_e);
    const double occupied_rate = c * c * kLog2E / (2 * metres * s.rho_o * s.rho_o);
    k.empty_rate = static_cast<float>(empty_rate);
    k.empty_rate_rest = static_cast<float>(empty_rate - k.empty_rate);
    k.occupied_rate = static_cast<float>(occupied_rate);
    k.occupied_rate_rest = static_cast<float>(occupied_rate - k.occupied_rate);
    k.peak_inverse = static_cast<float>(c / peak);
    k.peak_offset = static_cast<float>(metres / peak - 1.1);
    k.paradox_scale = static_cast<float>(std::sqrt(s.rho_c / 80));
    k.range = static_cast<float>(r);
    k.range_twice = static_cast<float>(2 * r);
    k.range_twice_inverse = static_cast<float>(1 / (2 * r));
    k.shell_slope = static_cast<float>(s.rho_i / r);
    k.shell_offset = static_cast<float>(-s.rho_i * s.epsilon_ratio);
    q.free_radius = static_cast<float>(li_free_radius(empty_rate, occupied_rate, r));
  }
  q.outer = static_cast<float>(outer);
  q.inner = static_cast<float>(std::max(quantise(s.min_range_m / c, t.lattice), 1 / t.lattice));
  // Far below it by any rounding, of the float distance in the kernel (2^-22 of it) or of these lines.
  q.within_radius = static_cast<float>(std::min(within, outer) * (1 - 1e-5) - 0.01);
  q.ring[kOuter] = ring(outer);
  q.ring[kInner] = ring(std::max(quantise(s.min_range_m / c, t.lattice), 1 / t.lattice));
  q.ring[kEdge] = ring(edge);
  return q;
}

}  // namespace evigrid::kernels
