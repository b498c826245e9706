// SPDX-License-Identifier: Apache-2.0
// What a planner sees of a map: for each cell how dear a step into it is, and where no step may go.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace evigrid::driver {

struct GridCell {
  int x = 0, y = 0;
  friend bool operator==(const GridCell&, const GridCell&) = default;
};

inline constexpr float kBlocked = std::numeric_limits<float>::infinity();

/// cost: factor on the length of a step into the cell, at least 1; kBlocked where there is no way. Row-major.
struct CostGrid {
  int width = 0, height = 0;
  std::vector<float> cost;

  CostGrid() = default;
  CostGrid(int w, int h, float fill = 1)
      : width(w), height(h), cost(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}
  [[nodiscard]] bool inside(GridCell c) const { return c.x >= 0 && c.y >= 0 && c.x < width && c.y < height; }
  [[nodiscard]] std::size_t index(GridCell c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(c.x);
  }
  [[nodiscard]] GridCell cell(std::size_t i) const {
    const auto w = static_cast<std::size_t>(width);
    return {static_cast<int>(i % w), static_cast<int>(i / w)};
  }
  [[nodiscard]] bool free(GridCell c) const { return inside(c) && cost[index(c)] != kBlocked; }
};

}  // namespace evigrid::driver
