// SPDX-License-Identifier: Apache-2.0
#include "kernels/row/compile_reading.hpp"

#include <algorithm>
#include <cmath>

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

double quantise(double cells, double lattice) { return std::nearbyint(cells * lattice) / lattice; }

Ring ring(double t) {
  const double t2 = t * t;  // exact: t has at most 22 bits
  const float hi = static_cast<float>(t2);
  return {hi, static_cast<float>(t2 - hi)};
}

struct Direction {
  float x, y;
};
Direction direction(double angle) {
  const SinCos sc = portable_sincos(angle);
  Direction d{static_cast<float>(sc.cos), static_cast<float>(sc.sin)};
  if (std::fabs(d.x) < 1e-7f) return {0.0f, d.y > 0 ? 1.0f : -1.0f};
  if (std::fabs(d.y) < 1e-7f) return {d.x > 0 ? 1.0f : -1.0f, 0.0f};
  return d;
}

template <class Reading>
void place(Reading& q, const SensorPose& pose, double cell_m, double lattice) {
  const double x = pose.x_m / cell_m - 0.5, y = pose.y_m / cell_m - 0.5;
  q.i0 = static_cast<std::int64_t>(std::floor(x));
  q.j0 = static_cast<std::int64_t>(std::floor(y));
  q.fx = static_cast<float>(quantise(x - static_cast<double>(q.i0), lattice));
  q.fy = static_cast<float>(quantise(y - static_cast<double>(q.j0), lattice));
}

}  // namespace

double lattice_steps(double reach_cells) noexcept {
  int bits = 0;
  while (bits < 22 && std::ldexp(1.0, bits) < reach_cells + 8) ++bits;
  return std::ldexp(1.0, std::min(16, 22 - bits));
}

ConeType::ConeType(const ConeSpec& s) : spec(s) {
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
  const Direction left = direction(pose.yaw_rad + s.aperture_rad / 2),
                  right = direction(pose.yaw_rad - s.aperture_rad / 2);
  q.lx = left.x, q.ly = left.y, q.rx = right.x, q.ry = right.y;
  q.reliability = static_cast<float>(s.reliability);
  q.doubt = static_cast<float>(1 - s.reliability);
  const double r = quantise(range_m / c, t.lattice), metres = r * c;
  double outer, edge;
  if (s.model == 0) {
    const double tolerance = quantise(s.tolerance_m / c, t.lattice);
    outer = std::min(r + tolerance, quantise(s.r_max_m / c, t.lattice));
    edge = std::max(r - tolerance, 0.0);
    q.hughes.slope = static_cast<float>(-c / (2 * s.r_max_m));
    q.hughes.max_occupied = static_cast<float>(s.max_occupied);
    std::copy(t.margin, t.margin + 4, q.hughes.margin);
  } else {
    outer = quantise(r * (1 + 2 * s.epsilon_ratio), t.lattice);
    edge = r;
    LiConstants& k = q.li;
    std::copy(t.lambda, t.lambda + 4, k.lambda);
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
  }
  q.outer = static_cast<float>(outer);
  q.ring[kOuter] = ring(outer);
  q.ring[kInner] = ring(std::max(quantise(s.min_range_m / c, t.lattice), 1 / t.lattice));
  q.ring[kEdge] = ring(edge);
  return q;
}

void compile_fan(const FanSpec& s, const SensorPose& pose, const float* ranges_m, Fan& out) {
  constexpr double kTwoPi = 6.283185307179586;
  const double c = s.cell_m, lattice = lattice_steps(s.max_range_m / c);
  FanReading q;
  place(q, pose, c, lattice);
  q.beams = s.beams;
  q.full_circle = s.beams * std::fabs(s.beam_step_rad) > kTwoPi - s.beam_step_rad / 2;
  const double half_width = quantise(s.half_width_m / c, lattice), margin = quantise(s.empty_margin_m / c, lattice);
  const double far = quantise(s.max_range_m / c, lattice);
  out.range.resize(static_cast<std::size_t>(s.beams));
  out.border_x.resize(static_cast<std::size_t>(s.beams) + 1);
  out.border_y.resize(static_cast<std::size_t>(s.beams) + 1);
  out.x_min = out.x_max = out.y_min = out.y_max = 0;
  for (int i = 0; i <= s.beams; ++i) {
    const Direction d = direction(pose.yaw_rad + (s.first_beam_rad + (i - 0.5) * s.beam_step_rad));
    const auto at = static_cast<std::size_t>(i);
    out.border_x[at] = d.x;
    out.border_y[at] = d.y;
    if (i == s.beams) break;
    const double r = ranges_m[i];
    out.range[at] = r < 0 ? kNoBeam : static_cast<float>(r > s.max_range_m ? far + margin : quantise(r / c, lattice));
  }
  for (std::size_t i = 0; i < out.range.size(); ++i) {  // box: both borders of a beam at its reach (and a little)
    if (out.range[i] < 0) continue;
    const double reach = std::min(out.range[i] + half_width, far);
    for (std::size_t b = i; b <= i + 1; ++b) {
      // The arc between two borders bulges beyond their ends by less than 1/cos(step/2).
      const double stretch = 1 + s.beam_step_rad * s.beam_step_rad;
      out.x_min = std::min(out.x_min, reach * stretch * out.border_x[b]);
      out.x_max = std::max(out.x_max, reach * stretch * out.border_x[b]);
      out.y_min = std::min(out.y_min, reach * stretch * out.border_y[b]);
      out.y_max = std::max(out.y_max, reach * stretch * out.border_y[b]);
    }
  }
  const SinCos mid = portable_sincos(pose.yaw_rad + (s.first_beam_rad + 0.5 * (s.beams - 1) * s.beam_step_rad));
  q.mid_cos = static_cast<float>(mid.cos);
  q.mid_sin = static_cast<float>(mid.sin);
  q.beams_per_rad = static_cast<float>(1 / s.beam_step_rad);
  q.half_beams = static_cast<float>(0.5 * s.beams);
  q.angle_slack = static_cast<float>(3e-5 / s.beam_step_rad + 1e-6 * s.beams);
  q.near = static_cast<float>(std::max(quantise(s.min_range_m / c, lattice), 1 / lattice));
  q.far = static_cast<float>(far);
  q.empty_margin = static_cast<float>(margin);
  q.half_width = static_cast<float>(half_width);
  q.empty = static_cast<float>(s.empty * s.reliability);
  q.occupied = static_cast<float>(s.occupied * s.reliability);
  q.fall = static_cast<float>(c / (2 * s.max_range_m));
  q.range = out.range.data();
  q.border_x = out.border_x.data();
  q.border_y = out.border_y.data();
  out.reading = q;
}

}  // namespace evigrid::kernels
