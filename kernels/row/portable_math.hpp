// SPDX-License-Identifier: Apache-2.0
// Sine, cosine and the few functions that a reading's constants need, in double from + − × ÷ √ and fma alone: libm's
// results differ between processors, and the map's bits must not. Errors stay below 1e-15 over the ranges used here.
#pragma once
#include <cstdint>

namespace evigrid::kernels {

/// What a map takes for 0 (docs/maths.md): so that no denormal arises.
inline constexpr float kLeastMass = 1e-12f;

struct SinCos {
  double sin, cos;
};
/// Any finite angle, in radians; accurate to 1e-15 up to |angle| = 1e5.
SinCos portable_sincos(double angle_rad) noexcept;
/// |x| ≤ 0.8.
double portable_asin(double x) noexcept;
/// |x| ≤ 700.
double portable_exp(double x) noexcept;
/// exp(−Δt/τ) from a stamp to now; 1 where τ is 0 and where time runs backwards.
float portable_share_left(std::int64_t stamp_ns, float tau_s, std::int64_t now_ns) noexcept;
double portable_tanh(double x) noexcept;
/// Natural logarithm of a normal x > 0; −inf at 0.
double portable_log(double x) noexcept;

}  // namespace evigrid::kernels
