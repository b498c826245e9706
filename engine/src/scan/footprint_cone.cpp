// SPDX-License-Identifier: Apache-2.0
// Cones: analytic spans, four rows of cells at a time.
#include <algorithm>
#include <cmath>

#include "scan/footprint.hpp"

namespace evigrid {
namespace {

/// Narrows [lo, hi] of dx so that dx·nx + dy·ny ≥ 0 can hold for some dy in [ya, yb].
void clip(double nx, double ny, double ya, double yb, double& lo, double& hi) {
  const double best = std::max(ny * ya, ny * yb);  // most that dy can give
  if (std::fabs(nx) < 1e-9) {
    if (best < -1e-6) hi = lo - 1;
    return;
  }
  const double bound = -best / nx;
  if (nx > 0) {
    lo = std::max(lo, bound);
  } else {
    hi = std::min(hi, bound);
  }
}

}  // namespace

CellBox footprint_box(const Footprint& f) {
  if (f.fan) {
    const auto& q = f.fan->reading;
    return {q.i0 + static_cast<std::int64_t>(std::floor(f.fan->x_min)) - 1,
            q.j0 + static_cast<std::int64_t>(std::floor(f.fan->y_min)) - 1,
            q.i0 + static_cast<std::int64_t>(std::ceil(f.fan->x_max)) + 2,
            q.j0 + static_cast<std::int64_t>(std::ceil(f.fan->y_max)) + 2};
  }
  const auto& q = f.cone;
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  const auto reach = [&](double x, double y) {
    x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
  };
  const double l = q.outer;
  reach(l * q.lx, l * q.ly);
  reach(l * q.rx, l * q.ry);
  constexpr double kAxes[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  for (const auto& a : kAxes) {
    if (a[0] * q.ly - a[1] * q.lx >= 0 && q.rx * a[1] - q.ry * a[0] >= 0) reach(l * a[0], l * a[1]);
  }
  return {q.i0 + static_cast<std::int64_t>(std::floor(x0)) - 1, q.j0 + static_cast<std::int64_t>(std::floor(y0)) - 1,
          q.i0 + static_cast<std::int64_t>(std::ceil(x1)) + 2, q.j0 + static_cast<std::int64_t>(std::ceil(y1)) + 2};
}

void select_micros(const kernels::ConeReading& q, double x0, double y0, MicroList& out) {
  constexpr double kPad = 0.01;  // cells; far above every rounding here
  out.count = 0;
  const double l = static_cast<double>(q.outer) + kPad;
  for (int band = 0; band < kernels::kMicrosPerSide; ++band) {
    const double ya = y0 + 4 * band - kPad, yb = y0 + 4 * band + 3 + kPad;
    const double nearest = ya > 0 ? ya : yb < 0 ? -yb : 0;
    if (nearest > l) continue;
    double hi = std::sqrt(l * l - nearest * nearest), lo = -hi;
    clip(q.ly, -q.lx, ya, yb, lo, hi);  // right of the left edge
    clip(-q.ry, q.rx, ya, yb, lo, hi);  // left of the right edge
    lo -= x0 + kPad, hi -= x0 - kPad;   // columns of the tile
    if (hi < lo || hi < 0 || lo > kernels::kTileSide - 1) continue;
    const int first = static_cast<int>(std::max(lo, 0.0)) / 4, last = static_cast<int>(std::min(hi, 63.0)) / 4;
    for (int m = first; m <= last; ++m)
      out.micro[static_cast<std::size_t>(out.count++)] = static_cast<std::uint8_t>(band * 16 + m);
  }
}

}  // namespace evigrid
