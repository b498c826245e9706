// SPDX-License-Identifier: Apache-2.0
// The exact decision of fan_exact.hpp, as text that a device compiles too: doubles, products and comparisons.
#pragma once
#include "kernels/row/reading.hpp"

#ifdef __CUDACC__
#define EVIGRID_BOTH_SIDES __host__ __device__
#else
#define EVIGRID_BOTH_SIDES
#endif

namespace evigrid::kernels {

EVIGRID_BOTH_SIDES inline bool in_beam(const FanReading& q, double dx, double dy, int i) {
  const double below = static_cast<double>(q.border_x[i]) * dy - static_cast<double>(q.border_y[i]) * dx;
  const double above = static_cast<double>(q.border_y[i + 1]) * dx - static_cast<double>(q.border_x[i + 1]) * dy;
  return (i == 0 ? below >= 0 : below > 0) && above >= 0;
}

/// As fan_class_exact.
EVIGRID_BOTH_SIDES inline int fan_class(const FanReading& q, float dx, float dy, int candidate) {
  const double x = dx, y = dy, d2 = x * x + y * y;
  const double near2 = static_cast<double>(q.near) * q.near, far2 = static_cast<double>(q.far) * q.far;
  if (d2 < near2 || d2 > far2) return 0;
  int beam = -1;
  for (int step = -1; step <= 1; ++step) {  // on a border two beams hold it: the lower index wins, also across the seam
    int i = candidate + step;
    if (q.full_circle) i = (i % q.beams + q.beams) % q.beams;
    if (i >= 0 && i < q.beams && (beam < 0 || i < beam) && in_beam(q, x, y, i)) beam = i;
  }
  if (beam < 0) return 0;
  const double r = q.range[beam], empty_end = r - q.empty_margin, from = r - q.half_width, to = r + q.half_width;
  if (empty_end > 0 && d2 < empty_end * empty_end) return 1;
  if (to >= 0 && d2 <= to * to && (from <= 0 || d2 >= from * from)) return 2;
  return 0;
}

}  // namespace evigrid::kernels
