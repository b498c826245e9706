// SPDX-License-Identifier: Apache-2.0
// A fan on the lattice. Borders are turned by the pose instead of taking a sine each: a scan of 360 beams costs a few
// microseconds. Beside the ranges there are tables of their extremes over runs of beams, from which whole squares of
// cells are found to be out of reach or entirely empty (select_fan.hpp).
#include <bit>

#include "kernels/row/lattice.hpp"

namespace evigrid::kernels {
namespace {

constexpr double kTwoPi = 6.283185307179586;
/// Squares look at most this wide from the apex: nearer ones are not judged as a whole (select_fan.hpp).
constexpr double kWidestSquare_rad = 1.6;

void build_reach(Fan& f, bool full_circle, double beams_per_rad) {
  const std::size_t n = f.range.size(), stride = full_circle ? 2 * n : n;
  const auto widest = static_cast<std::size_t>(kWidestSquare_rad * beams_per_rad) + 6;
  const int levels = std::bit_width(std::min(stride, widest));
  f.reach.resize(static_cast<std::size_t>(levels) * stride);
  float longest = 1;
  for (const float r : f.range) longest = r > longest ? r : longest;
  const float unit = longest / 65000.0f, per_unit = 65000.0f / longest;
  for (std::size_t i = 0; i < n; ++i) {
    const float r = f.range[i] > 0 ? f.range[i] * per_unit : 0.0f;
    const auto below = static_cast<std::uint32_t>(static_cast<std::int32_t>(r));  // one more and less cover rounding
    f.reach[i] = (below + 2) << 16 | (below > 0 ? below - 1 : 0);
    if (full_circle) f.reach[n + i] = f.reach[i];
  }
  for (int l = 1; l < levels; ++l) {
    const std::size_t half = std::size_t{1} << (l - 1);
    std::uint32_t* const row = f.reach.data() + static_cast<std::size_t>(l) * stride;
    const std::uint32_t* const under = row - stride;
    for (std::size_t i = 0; i + 2 * half <= stride; ++i) {
      const std::uint32_t p = under[i], q = under[i + half];
      row[i] = std::max(p & 0xffff0000u, q & 0xffff0000u) | std::min(p & 0xffffu, q & 0xffffu);
    }
  }
  f.reading.reach = f.reach.data();
  f.reading.reach_stride = static_cast<int>(stride);
  f.reading.reach_levels = levels;
  f.reading.reach_unit = unit;
}

}  // namespace

double lattice_steps(double reach_cells) noexcept {
  int bits = 0;
  while (bits < 22 && std::ldexp(1.0, bits) < reach_cells + 8) ++bits;
  return std::ldexp(1.0, std::min(16, 22 - bits));
}

FanType::FanType(const FanSpec& s)
    : spec(s),
      lattice(lattice_steps(s.max_range_m / s.cell_m)),
      full_circle(s.beams * std::fabs(s.beam_step_rad) > kTwoPi - s.beam_step_rad / 2) {
  for (int i = 0; i <= s.beams; ++i) {
    const SinCos border = portable_sincos(s.first_beam_rad + (i - 0.5) * s.beam_step_rad);
    border_cos.push_back(border.cos);
    border_sin.push_back(border.sin);
  }
  const SinCos mid = portable_sincos(s.first_beam_rad + 0.5 * (s.beams - 1) * s.beam_step_rad);
  mid_cos = mid.cos;
  mid_sin = mid.sin;
}

void compile_fan(const FanType& type, const SensorPose& pose, Fan& out) {
  const FanSpec& s = type.spec;
  const double c = s.cell_m, lattice = type.lattice;
  const auto n = static_cast<std::size_t>(s.beams);
  FanReading& q = out.reading;
  q = {};
  place(q, pose, c, lattice);
  q.beams = s.beams;
  q.full_circle = type.full_circle;
  const double half_width = quantise(s.half_width_m / c, lattice), margin = quantise(s.empty_margin_m / c, lattice);
  const double far = quantise(s.max_range_m / c, lattice);
  out.border_x.resize(n + 1);
  out.border_y.resize(n + 1);
  const SinCos yaw = portable_sincos(pose.yaw_rad);
  for (std::size_t i = 0; i <= n; ++i) {
    const Direction d = direction(yaw.cos * type.border_cos[i] - yaw.sin * type.border_sin[i],
                                  yaw.sin * type.border_cos[i] + yaw.cos * type.border_sin[i]);
    out.border_x[i] = d.x;
    out.border_y[i] = d.y;
  }
  // The arc between two borders bulges beyond their ends by less than 1/cos(step/2).
  const auto stretch = static_cast<float>(1 + s.beam_step_rad * s.beam_step_rad);
  float x_min = 0, x_max = 0, y_min = 0, y_max = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double r = out.range[i];
    if (r < 0) {
      out.range[i] = kNoBeam;
      continue;
    }
    out.range[i] = static_cast<float>(r > s.max_range_m ? far + margin : quantise(r / c, lattice));
    const float reach = std::min(out.range[i] + static_cast<float>(half_width), static_cast<float>(far)) * stretch;
    for (std::size_t b = i; b <= i + 1; ++b) {
      x_min = std::min(x_min, reach * out.border_x[b]);
      x_max = std::max(x_max, reach * out.border_x[b]);
      y_min = std::min(y_min, reach * out.border_y[b]);
      y_max = std::max(y_max, reach * out.border_y[b]);
    }
  }
  out.x_min = x_min, out.x_max = x_max, out.y_min = y_min, out.y_max = y_max;
  q.mid_cos = static_cast<float>(yaw.cos * type.mid_cos - yaw.sin * type.mid_sin);
  q.mid_sin = static_cast<float>(yaw.sin * type.mid_cos + yaw.cos * type.mid_sin);
  q.beams_per_rad = static_cast<float>(1 / s.beam_step_rad);
  q.half_beams = static_cast<float>(0.5 * s.beams);
  q.half_angle = static_cast<float>(0.5 * s.beams * s.beam_step_rad);
  // Polynomial 3.2e-7, quadrant and products 5e-7, floats of the borders and of the middle 2e-7 rad: 2.5e-6 holds all.
  q.angle_slack = static_cast<float>(2.5e-6 / s.beam_step_rad + 2e-7 * s.beams);
  q.near = static_cast<float>(std::max(quantise(s.min_range_m / c, lattice), 1 / lattice));
  q.far = static_cast<float>(far);
  q.empty_margin = static_cast<float>(margin);
  q.half_width = static_cast<float>(half_width);
  q.empty = static_cast<float>(s.empty * s.reliability * s.reliability_if_occupied);
  q.occupied = static_cast<float>(s.occupied * s.reliability * s.reliability_if_empty);
  q.fall = static_cast<float>(c / (2 * s.max_range_m));
  q.range = out.range.data();
  q.border_x = out.border_x.data();
  q.border_y = out.border_y.data();
  build_reach(out, type.full_circle, 1 / s.beam_step_rad);
}

}  // namespace evigrid::kernels
