// SPDX-License-Identifier: Apache-2.0
// One row a cone model: how far it reaches, where its own ring lies, and its constants as floats. Lengths on the
// lattice of docs/maths.md; constants in double first.
#include "kernels/row/compile_cone.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/row/lattice.hpp"

namespace evigrid::kernels {
namespace {

constexpr double kLog2E = 1.44269504088896340736;
constexpr double kTanhReach_m = 5;  // beyond ρv; there ρ = 2.1e-9

/// Metres to cells on a lattice; with no steps as they are.
struct Rounding {
  double cell_m, steps;
  [[nodiscard]] double cells(double c) const noexcept { return steps > 0 ? quantise(c, steps) : c; }
  [[nodiscard]] double metres(double m) const noexcept { return cells(m / cell_m); }
  [[nodiscard]] double width(double m) const noexcept { return std::max(metres(m), steps > 0 ? 1 / steps : 0); }
};

float rounded(double v) { return static_cast<float>(v); }

Ring ring(double t) {
  const double t2 = t * t;  // exact: t has at most 22 bits
  const float hi = static_cast<float>(t2);
  return {hi, static_cast<float>(t2 - hi)};
}

/// sin²α of the sensor over that of its edges as they are: rounded to float they open to another angle, by 1e-5 of a
/// small one.
double edge_ratio(const ConeType& t, const ConeReading& q) {
  const double lx = q.lx, ly = q.ly, rx = q.rx, ry = q.ry, sine = portable_sincos(t.spec.aperture_rad / 2).sin;
  return sine * sine / ((std::sqrt((lx * lx + ly * ly) * (rx * rx + ry * ry)) - (lx * rx + ly * ry)) / 2);
}

/// The fit of λ for those edges.
void fit_lambda(const ConeType& t, double ratio, float (&out)[4]) {
  double power = ratio;
  for (int i = 0; i < 4; ++i, power *= ratio) out[i] = rounded(t.lambda[i] * power);
}

/// Half of the angle between the edges as they are, over half of the aperture: on their grid they are off by up to
/// 4e-8 rad each, which a narrow cone's λ would feel in every like reading.
double opening(const ConeType& t, const ConeReading& q) {
  const double lx = q.lx, ly = q.ly, rx = q.rx, ry = q.ry;
  const double sine = rx * ly - ry * lx, cosine = rx * lx + ry * ly;
  const double more = (sine * t.aperture_cos - cosine * t.aperture_sin) / std::sqrt(sine * sine + cosine * cosine);
  return 1 + more / t.spec.aperture_rad;
}

/// r: the range in cells, on the lattice.
struct Row {
  double (*reach_m)(const ConeSpec&);
  ConeLimits (*limits)(const ConeSpec&, const Rounding&, double r);
  void (*constants)(const ConeType&, const Rounding&, double r, ConeReading&);
};

double hughes_reach(const ConeSpec& s) { return s.max_range_m + s.tolerance_m; }
ConeLimits hughes_limits(const ConeSpec& s, const Rounding& to, double r) {
  const double tolerance = to.metres(s.tolerance_m);
  const double edge = std::max(r - tolerance, 0.0);
  return {std::min(r + tolerance, to.metres(s.r_max_m)), edge, edge};
}
void hughes_constants(const ConeType& t, const Rounding& to, double, ConeReading& q) {
  q.hughes = {};
  q.hughes.slope = rounded(-to.cell_m / (2 * t.spec.r_max_m));
  q.hughes.max_occupied = rounded(t.spec.max_occupied);
  const double open = opening(t, q);
  for (int i = 0; i < 4; ++i) q.hughes.margin[i] = rounded(t.margin[i] / open);
}

/// Where the occupied mass over the empty one, 2^(d²·empty_rate − (d − R)²·occupied_rate), is below 2^-30.4 and the kernel
/// takes it for zero (model_li2014.hpp). The smaller root of the quadratic; negative where there is none.
double li2014_free_radius(double empty_rate, double occupied_rate, double r) {
  const double a = occupied_rate - empty_rate, b = occupied_rate * r, c = b * r - 30.4;
  const double root = b * b - a * c;
  if (c <= 0 || root <= 0) return -1;
  return c / (b + std::sqrt(root)) - 0.01;
}

double li2014_reach(const ConeSpec& s) { return s.max_range_m * (1 + 2 * s.epsilon_ratio); }
ConeLimits li2014_limits(const ConeSpec& s, const Rounding& to, double r) {
  return {to.cells(r * (1 + 2 * s.epsilon_ratio)), r, r * (1 + s.epsilon_ratio)};
}
void li2014_constants(const ConeType& t, const Rounding& to, double r, ConeReading& q) {
  const ConeSpec& s = t.spec;
  const double c = to.cell_m, metres = r * c;
  LiConstants& k = q.li;
  const double open = opening(t, q);
  for (int i = 0; i < 4; ++i) k.lambda[i] = rounded(t.lambda[i] / (open * open));
  std::copy(t.shell, t.shell + 4, k.shell);
  const double root = std::sqrt(metres);
  const double peak = s.rho_e * root * metres / (s.rho_e * root + s.rho_o);  // e^β
  const double empty_rate = c * c * kLog2E / (2 * metres * s.rho_e * metres * s.rho_e);
  const double occupied_rate = c * c * kLog2E / (2 * metres * s.rho_o * s.rho_o);
  k.empty_rate = rounded(empty_rate);
  k.empty_rate_rest = rounded(empty_rate - k.empty_rate);
  k.occupied_rate = rounded(occupied_rate);
  k.occupied_rate_rest = rounded(occupied_rate - k.occupied_rate);
  k.peak_inverse = rounded(c / peak);
  k.peak_offset = rounded(metres / peak - 1.1);
  k.paradox_scale = rounded(std::sqrt(s.rho_c / 80));
  k.range = rounded(r);
  k.range_twice = rounded(2 * r);
  k.range_twice_inverse = rounded(1 / (2 * r));
  k.shell_slope = rounded(s.rho_i / r);
  k.shell_offset = rounded(-s.rho_i * s.epsilon_ratio);
  q.free_radius = rounded(li2014_free_radius(empty_rate, occupied_rate, r));
}

double tanh_reach(const ConeSpec& s) { return s.max_range_m + s.width_m; }
ConeLimits tanh_limits(const ConeSpec& s, const Rounding& to, double r) {
  return {std::min(r + to.width(s.width_m), to.metres(s.rho_v_m + kTanhReach_m)), r};
}
void tanh_constants(const ConeType& t, const Rounding& to, double r, ConeReading& q) {
  const ConeSpec& s = t.spec;
  const double width = to.width(s.width_m), outer = tanh_limits(s, to, r).outer, alpha = s.aperture_rad / 2;
  q.tanh = {};
  TanhConstants& k = q.tanh;
  std::copy(t.lambda, t.lambda + 4, k.lambda);
  k.gamma = rounded(1 - alpha * alpha / 2);
  k.gamma_slope = rounded(alpha * alpha / 2);
  k.range = rounded(r);
  k.reach = rounded(outer);
  k.gap = rounded(r + width - outer);
  k.width_inverse = rounded(1 / width);
  k.decay = rounded(4 * kLog2E * to.cell_m);
  k.decay_offset = rounded(-4 * kLog2E * s.rho_v_m);
  k.k_empty = rounded(s.k_empty);
  k.k_occupied = rounded(s.k_occupied);
  k.as_printed = s.as_printed;
}

double li2006_reach(const ConeSpec& s) { return s.max_range_m + s.li2006_epsilon_m; }
ConeLimits li2006_limits(const ConeSpec& s, const Rounding& to, double r) {
  return {r + to.metres(s.li2006_epsilon_m), r};
}
void li2006_constants(const ConeType& t, const Rounding& to, double r, ConeReading& q) {
  const ConeSpec& s = t.spec;
  const double c = to.cell_m;
  q.li2006 = {};
  Li2006Constants& k = q.li2006;
  if (s.discount_by_lambda) {
    const double ratio = edge_ratio(t, q);
    fit_lambda(t, ratio, k.lambda);
    for (int i = 0; i < 4; ++i) k.off_axis[i] = rounded(t.off_axis[i] * ratio);
  }
  k.rest = s.discount_by_lambda ? 0 : 1;
  k.range = rounded(r);
  k.range_twice = rounded(2 * r);
  k.range_inverse_square = rounded(1 / (r * r));
  const double occupied_rate = 3 * s.li2006_rho_v * c * c * kLog2E;
  k.occupied_rate = rounded(occupied_rate);
  k.occupied_rate_rest = rounded(occupied_rate - k.occupied_rate);
  k.both_slope = rounded(2 / r);
  k.both_offset = rounded(4 * to.metres(s.li2006_epsilon_m) / r);
  k.unknown_rate = rounded(4 * c);
}

double moravec_reach(const ConeSpec& s) { return s.max_range_m + s.moravec_epsilon_m; }
ConeLimits moravec_limits(const ConeSpec& s, const Rounding& to, double r) {
  const double epsilon = to.width(s.moravec_epsilon_m);
  return {r + epsilon, std::max(r - epsilon, 0.0)};
}
void moravec_constants(const ConeType& t, const Rounding& to, double r, ConeReading& q) {
  const ConeSpec& s = t.spec;
  const double epsilon = to.width(s.moravec_epsilon_m), depth = r - epsilon - to.width(s.min_range_m);
  // ∫ λ dθ = 2ω/3 and ∫ O d dd = 4εR/3, in cells; a sum over less than one cell is one cell's.
  const double n = std::max(8.0 / 9 * s.aperture_rad * epsilon * r, 1.0);
  q.moravec = {};
  MoravecConstants& k = q.moravec;
  fit_lambda(t, edge_ratio(t, q), k.lambda);
  k.border = rounded(std::max(r - epsilon, 0.0));
  k.border_shift = rounded(std::max(epsilon - r, 0.0));
  k.reach = rounded(r + epsilon);
  k.depth_inverse = rounded(depth > 0 ? 1 / depth : 0);
  k.occupied = rounded(1 / (epsilon * epsilon * n));
}

constexpr Row kRows[kConeModels] = {
    {hughes_reach, hughes_limits, hughes_constants},   {li2014_reach, li2014_limits, li2014_constants},
    {tanh_reach, tanh_limits, tanh_constants},         {li2006_reach, li2006_limits, li2006_constants},
    {tanh_reach, tanh_limits, tanh_constants},         {tanh_reach, tanh_limits, tanh_constants},
    {moravec_reach, moravec_limits, moravec_constants}};

}  // namespace

double farthest_reach_m(const ConeSpec& s) noexcept { return kRows[s.model].reach_m(s); }

ConeLimits cone_limits_m(const ConeSpec& s, double range_m) noexcept {
  return kRows[s.model].limits(s, {1, 0}, range_m);
}

void compile_model(const ConeType& t, double range_m, ConeReading& q) noexcept {
  const Row& row = kRows[t.spec.model];
  const Rounding to{t.spec.cell_m, t.lattice};
  const double r = to.metres(range_m);
  const ConeLimits at = row.limits(t.spec, to, r);
  row.constants(t, to, r, q);
  const double inner = to.width(t.spec.min_range_m);
  q.outer = rounded(at.outer);
  q.inner = rounded(inner);
  // Far below it by any rounding, of the float distance in the kernel (2^-22 of it) or of these lines.
  q.within_radius = rounded(std::min(at.within, at.outer) * (1 - 1e-5) - 0.01);
  q.ring[kOuter] = ring(at.outer);
  q.ring[kInner] = ring(inner);
  q.ring[kEdge] = ring(at.edge);
}

}  // namespace evigrid::kernels
