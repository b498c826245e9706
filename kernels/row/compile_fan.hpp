// SPDX-License-Identifier: Apache-2.0
// A fan on the lattice. Borders are turned by the pose instead of taking a sine each. Beside the ranges there are
// tables of their extremes over runs of beams, from which whole squares of cells are found to be out of reach or
// entirely empty (select_fan.hpp). Plain loops, compiled for each target: only operations that IEEE 754 rounds
// correctly, so every table compiles the same fan.
#pragma once
#include <bit>

#include "kernels/row/kernel_table.hpp"
#include "kernels/row/lattice.hpp"

EVIGRID_CELL_BEGIN

/// Squares look at most this wide from the apex: nearer ones are not judged as a whole (select_fan.hpp).
inline constexpr double kWidestSquare_rad = 1.6;

inline void turn_borders(const FanType& type, const SinCos& yaw, std::size_t count, float* to_x, float* to_y) {
  const double* const from_cos = type.border_cos.data();
  const double* const from_sin = type.border_sin.data();
  for (std::size_t i = 0; i < count; ++i) {  // `direction`, without a branch
    const auto x = static_cast<float>(yaw.cos * from_cos[i] - yaw.sin * from_sin[i]);
    const auto y = static_cast<float>(yaw.sin * from_cos[i] + yaw.cos * from_sin[i]);
    const bool no_x = (x < 0 ? -x : x) < 1e-7f, no_y = !no_x && (y < 0 ? -y : y) < 1e-7f;
    const float sign_x = x > 0 ? 1.0f : -1.0f, sign_y = y > 0 ? 1.0f : -1.0f;
    to_x[i] = no_x ? 0.0f : no_y ? sign_x : x;
    to_y[i] = no_y ? 0.0f : no_x ? sign_y : y;
  }
}

/// What can be touched, as a box around the apex. The arc between two borders bulges beyond their ends by less than
/// 1/cos(step/2).
inline void bound_fan(const FanReading& q, float stretch, std::size_t n, Fan& out) {
  using V = Lanes::V;
  const V zero(0.0f);
  V x_min = zero, x_max = zero, y_min = zero, y_max = zero;
  for (std::size_t i = 0; i < n; i += static_cast<std::size_t>(Lanes::kLanes)) {
    // No beam reaches less than 0: its product changes nothing.
    const V reach = max_of(min_of(Lanes::load_flat(q.range + i) + V(q.half_width), V(q.far)) * V(stretch), zero);
    for (std::size_t b = i; b <= i + 1; ++b) {
      const V x = reach * Lanes::load_flat(q.border_x + b), y = reach * Lanes::load_flat(q.border_y + b);
      x_min = min_of(x_min, x), x_max = max_of(x_max, x);
      y_min = min_of(y_min, y), y_max = max_of(y_max, y);
    }
  }
  out.x_min = -static_cast<double>(Lanes::reduce_max(zero - x_min)), out.x_max = Lanes::reduce_max(x_max);
  out.y_min = -static_cast<double>(Lanes::reduce_max(zero - y_min)), out.y_max = Lanes::reduce_max(y_max);
}

inline void build_reach(bool full_circle, double beams_per_rad, std::size_t n, Fan& f) {
  const std::size_t stride = full_circle ? 2 * n : n;
  const auto widest = static_cast<std::size_t>(kWidestSquare_rad * beams_per_rad) + 6;
  const int levels = std::bit_width(std::min(stride, widest));
  f.reach.resize(static_cast<std::size_t>(levels) * stride);
  const float* const range = f.reading.range;
  Lanes::V most(1.0f);
  for (std::size_t i = 0; i < n; i += static_cast<std::size_t>(Lanes::kLanes))  // beyond n there is no beam
    most = max_of(most, Lanes::load_flat(range + i));
  const float longest = Lanes::reduce_max(most), unit = longest / 65000.0f, per_unit = 65000.0f / longest;
  std::uint32_t* const lowest = f.reach.data();
  for (std::size_t i = 0; i < n; ++i) {
    const float r = range[i] > 0 ? range[i] * per_unit : 0.0f;
    const auto below = static_cast<std::uint32_t>(static_cast<std::int32_t>(r));  // one more and less cover rounding
    lowest[i] = (below + 2) << 16 | (below > 0 ? below - 1 : 0);
  }
  if (full_circle) std::copy(lowest, lowest + n, lowest + n);
  for (int l = 1; l < levels; ++l) {
    const std::size_t half = std::size_t{1} << (l - 1);
    std::uint32_t* const row = lowest + static_cast<std::size_t>(l) * stride;
    const std::uint32_t* const under = row - stride;
    for (std::size_t i = 0; i + 2 * half <= stride; ++i) {
      const std::uint32_t p = under[i], q = under[i + half];
      const std::uint32_t high_p = p & 0xffff0000u, high_q = q & 0xffff0000u, low_p = p & 0xffffu, low_q = q & 0xffffu;
      row[i] = (high_p > high_q ? high_p : high_q) | (low_p < low_q ? low_p : low_q);
    }
  }
  f.reading.reach = lowest;
  f.reading.reach_stride = static_cast<int>(stride);
  f.reading.reach_levels = levels;
  f.reading.reach_unit = unit;
}

inline void compile_fan(const FanType& type, const SensorPose& pose, Fan& out) {
  const FanSpec& s = type.spec;
  const double c = s.cell_m, lattice = type.lattice, step = 1 / lattice;  // a power of two: exact
  const auto n = static_cast<std::size_t>(s.beams);
  FanReading& q = out.reading;
  q = {};
  place(q, pose, c, lattice);
  q.beams = s.beams;
  q.full_circle = type.full_circle;
  const double half_width = quantise(s.half_width_m / c, lattice), margin = quantise(s.empty_margin_m / c, lattice);
  const double far = quantise(s.max_range_m / c, lattice), max_range = s.max_range_m;
  const SinCos yaw = portable_sincos(pose.yaw_rad);
  out.border_x.resize(n + 1 + kFanPad);
  out.border_y.resize(n + 1 + kFanPad);
  turn_borders(type, yaw, n + 1, out.border_x.data(), out.border_y.data());
  out.cells.resize(n + 2 * kFanPad);
  float* const cells = out.cells.data() + kFanPad;
  std::fill(cells - kFanPad, cells, kNoBeam);
  std::fill(cells + n, cells + n + kFanPad, kNoBeam);
  const float* const metres = out.range.data();
  for (std::size_t i = 0; i < n; ++i) {
    const double r = metres[i], on_lattice = nearest_integer(r / c * lattice) * step;
    const auto reading = static_cast<float>(r > max_range ? far + margin : on_lattice);
    cells[i] = r < 0 ? kNoBeam : reading;
  }
  q.mid_cos = static_cast<float>(yaw.cos * type.mid_cos - yaw.sin * type.mid_sin);
  q.mid_sin = static_cast<float>(yaw.sin * type.mid_cos + yaw.cos * type.mid_sin);
  q.beams_per_rad = static_cast<float>(1 / s.beam_step_rad);
  q.half_beams = static_cast<float>(0.5 * s.beams);
  q.half_angle = static_cast<float>(0.5 * s.beams * s.beam_step_rad);
  // Polynomial 3.2e-7, quadrant and products 5e-7, floats of the borders and of the middle 2e-7, the turn from a
  // square's centre 3e-7 rad: 2.5e-6 holds all.
  q.angle_slack = static_cast<float>(2.5e-6 / s.beam_step_rad + 2e-7 * s.beams);
  q.near = static_cast<float>(std::max(quantise(s.min_range_m / c, lattice), 1 / lattice));
  q.far = static_cast<float>(far);
  q.empty_margin = static_cast<float>(margin);
  q.half_width = static_cast<float>(half_width);
  q.empty = static_cast<float>(s.empty * s.reliability * s.reliability_if_occupied);
  q.occupied = static_cast<float>(s.occupied * s.reliability * s.reliability_if_empty);
  q.fall = static_cast<float>(c / (2 * s.max_range_m));
  q.range = cells;
  q.border_x = out.border_x.data();
  q.border_y = out.border_y.data();
  bound_fan(q, static_cast<float>(1 + s.beam_step_rad * s.beam_step_rad), n, out);
  build_reach(type.full_circle, 1 / s.beam_step_rad, n, out);
}

EVIGRID_CELL_END
