// SPDX-License-Identifier: Apache-2.0
// Putting a reading on the lattice of docs/maths.md.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "kernels/row/compile_reading.hpp"
#include "kernels/row/portable_math.hpp"

namespace evigrid::kernels {

/// To the nearest integer, ties to even, |t| < 2^51: what nearbyint does, without a call of the library.
inline double nearest_integer(double t) noexcept {
  constexpr double kMagic = 6755399441055744.0;  // 1.5 · 2^52
  return (t + kMagic) - kMagic;
}

inline double quantise(double cells, double lattice) noexcept { return nearest_integer(cells * lattice) / lattice; }

/// A direction as floats, nearly aligned ones aligned.
struct Direction {
  float x, y;
};
inline Direction direction(double cosine, double sine) noexcept {
  const Direction d{static_cast<float>(cosine), static_cast<float>(sine)};
  if (std::fabs(d.x) < 1e-7f) return {0.0f, d.y > 0 ? 1.0f : -1.0f};
  if (std::fabs(d.y) < 1e-7f) return {d.x > 0 ? 1.0f : -1.0f, 0.0f};
  return d;
}
inline Direction direction(double angle) noexcept {
  const SinCos sc = portable_sincos(angle);
  return direction(sc.cos, sc.sin);
}
/// The same on multiples of 2^-24, for the edges of cones: their products with offsets are then exact sums of two
/// floats (cone_lanes.hpp).
inline Direction edge_direction(double angle) noexcept {
  const Direction d = direction(angle);
  const auto on_grid = [](float t) { return static_cast<float>(nearest_integer(t * 16777216.0) / 16777216.0); };
  return {on_grid(d.x), on_grid(d.y)};
}

template <class Reading>
void place(Reading& q, const SensorPose& pose, double cell_m, double lattice) noexcept {
  const double x = pose.x_m / cell_m - 0.5, y = pose.y_m / cell_m - 0.5;
  q.i0 = static_cast<std::int64_t>(std::floor(x));
  q.j0 = static_cast<std::int64_t>(std::floor(y));
  q.fx = static_cast<float>(quantise(x - static_cast<double>(q.i0), lattice));
  q.fy = static_cast<float>(quantise(y - static_cast<double>(q.j0), lattice));
}

}  // namespace evigrid::kernels
