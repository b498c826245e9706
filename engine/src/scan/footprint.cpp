// SPDX-License-Identifier: Apache-2.0
#include "scan/footprint.hpp"

#include <algorithm>
#include <cmath>

namespace evigrid {
namespace {

template <class Reading>
CellBox box_about(const Reading& q, double x0, double x1, double y0, double y1) {
  return {q.i0 + static_cast<std::int64_t>(std::floor(x0)) - 1, q.j0 + static_cast<std::int64_t>(std::floor(y0)) - 1,
          q.i0 + static_cast<std::int64_t>(std::ceil(x1)) + 2, q.j0 + static_cast<std::int64_t>(std::ceil(y1)) + 2};
}

}  // namespace

CellBox fan_box(const kernels::Fan& f) { return box_about(f.reading, f.x_min, f.x_max, f.y_min, f.y_max); }

CellBox cone_box(const kernels::ConeReading& q) {
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
  return box_about(q, x0, x1, y0, y1);
}

}  // namespace evigrid
