// SPDX-License-Identifier: Apache-2.0
// What all fans of a sensor share: the directions of their borders, with one sine and cosine each.
#include "kernels/row/lattice.hpp"

namespace evigrid::kernels {
namespace {
constexpr double kTwoPi = 6.283185307179586;
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

}  // namespace evigrid::kernels
