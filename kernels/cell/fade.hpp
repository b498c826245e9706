// SPDX-License-Identifier: Apache-2.0
// Forgetting by time (engine/src/grid/decay.hpp), one cell: what is left after Δt, in double from operations that are
// exact or rounded correctly, and what becomes of a mass. Devices age their cells by it; the processor's own loop over
// a micro-tile (decay.cpp) does the same to vectors, and tests hold the two together.
#pragma once
#include <cmath>
#include <cstdint>

#include "kernels/row/portable_math.hpp"

EVIGRID_CELL_BEGIN

/// e^x for |x| ≤ 700.
EVIGRID_FN double exponential_in_double(double x) {
  const double n = std::nearbyint(x * 1.44269504088896340736);
  double r = std::fma(-n, 6.93147180559945286227e-01, x);
  r = std::fma(-n, 2.31904681384629955842e-17, r);
  double sum = 0;
  for (int k = 18; k >= 1; --k) sum = (1 + sum) * (r / k);
  return std::ldexp(1 + sum, static_cast<int>(n));
}

/// exp(−Δt/τ); 1 where nothing was ever heard (τ = 0) and where time runs backwards.
EVIGRID_FN float share_left(std::int64_t stamp_ns, float tau_s, std::int64_t now_ns) {
  if (tau_s <= 0 || now_ns <= stamp_ns) return 1.0f;
  const std::uint64_t elapsed = static_cast<std::uint64_t>(now_ns) - static_cast<std::uint64_t>(stamp_ns);
  const double x = static_cast<double>(elapsed) * 1e-9 / static_cast<double>(tau_s);
  return x > 700 ? 0.0f : static_cast<float>(exponential_in_double(-x));
}

/// Keeps `share` (below 1) of a mass; what it gives up joins `given_up`, what is left `left`.
EVIGRID_FN void keep_share(float share, float& mass, float& given_up, float& left) {
  const float kept = mass * share, now = kept < kLeastMass ? 0.0f : kept;
  given_up = given_up + (mass - now);
  left = left + now;
  mass = now;
}

EVIGRID_CELL_END
