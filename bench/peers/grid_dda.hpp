// SPDX-License-Identifier: Apache-2.0
// A yardstick, not a part of evigrid: rays by digital differential analysis (Amanatides & Woo 1987) over a bitmap of
// the world, as most simulators of grid robots do it. The same bitmap feeds MRPT's simulators.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bench/micro/cast_places.hpp"

namespace evigrid::bench {

struct Bitmap {
  double cell_m = 0.05;
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> wall;

  /// Every cell that a wall passes through, by points a quarter of a cell apart.
  Bitmap(const std::vector<std::pair<Point, Point>>& lines, double width_m, double height_m)
      : columns(static_cast<int>(width_m / cell_m) + 2), rows(static_cast<int>(height_m / cell_m) + 2) {
    wall.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (const auto& [from, to] : lines) {
      const double x = to.x_m - from.x_m, y = to.y_m - from.y_m;
      const int steps = static_cast<int>(std::hypot(x, y) / (cell_m / 4)) + 1;
      for (int k = 0; k <= steps; ++k) {
        const double share = static_cast<double>(k) / steps;
        mark(from.x_m + share * x, from.y_m + share * y);
      }
    }
  }
  void mark(double x_m, double y_m) {
    const int i = static_cast<int>(std::floor(x_m / cell_m)), j = static_cast<int>(std::floor(y_m / cell_m));
    if (i >= 0 && j >= 0 && i < columns && j < rows) wall[at(i, j)] = 1;
  }
  [[nodiscard]] std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i);
  }

  /// Distance at which the ray enters the first wall cell; range_m when there is none within it.
  [[nodiscard]] float cast(float x_m, float y_m, float dx, float dy, float range_m) const {
    const float size = static_cast<float>(cell_m), x = x_m / size, y = y_m / size, farthest = range_m / size;
    int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const int step_i = dx > 0 ? 1 : -1, step_j = dy > 0 ? 1 : -1;
    const float each_x = std::abs(1 / dx), each_y = std::abs(1 / dy);
    float next_x = (dx > 0 ? static_cast<float>(i + 1) - x : x - static_cast<float>(i)) * each_x;
    float next_y = (dy > 0 ? static_cast<float>(j + 1) - y : y - static_cast<float>(j)) * each_y;
    for (float t = 0; t < farthest;) {
      if (static_cast<unsigned>(i) >= static_cast<unsigned>(columns) ||
          static_cast<unsigned>(j) >= static_cast<unsigned>(rows))
        break;
      if (wall[at(i, j)] != 0) return t * size;
      if (next_x < next_y)
        t = next_x, next_x += each_x, i += step_i;
      else
        t = next_y, next_y += each_y, j += step_j;
    }
    return range_m;
  }
};

}  // namespace evigrid::bench
