// SPDX-License-Identifier: Apache-2.0
// The map of the experiment's field as the agents of the GERM robot read it: one fixed rectangle of cells, and the
// paper's decision: u < 0.5 and m(occupied) > m(empty) is occupied.
#pragma once
#include <cmath>
#include <vector>

#include "evigrid/map.hpp"
#include "evigrid/scenes/scene.hpp"
#include "navigate/cost_grid.hpp"

namespace evigrid::driver {

struct FieldRect {
  CellRect rect{};
  double cell_m = 0.01;
  [[nodiscard]] GridCell cell(raycast::Point p) const {
    return {static_cast<int>(std::floor(p.x_m / cell_m) - static_cast<double>(rect.x)),
            static_cast<int>(std::floor(p.y_m / cell_m) - static_cast<double>(rect.y))};
  }
  [[nodiscard]] raycast::Point centre(GridCell c) const {
    return {(static_cast<double>(rect.x + c.x) + 0.5) * cell_m, (static_cast<double>(rect.y + c.y) + 0.5) * cell_m};
  }
  [[nodiscard]] bool inside(GridCell c) const { return c.x >= 0 && c.y >= 0 && c.x < rect.width && c.y < rect.height; }
  [[nodiscard]] std::size_t index(GridCell c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(rect.width) + static_cast<std::size_t>(c.x);
  }
  [[nodiscard]] std::size_t cells() const { return static_cast<std::size_t>(rect.width * rect.height); }
};

/// The extent of the scene's world and `margin` cells more on every side.
[[nodiscard]] FieldRect field_of(const scenes::Scene& scene, int margin = 10);

/// 1 where the paper's final result map marks occupied, row-major over the field.
[[nodiscard]] std::vector<std::uint8_t> occupied_cells(const Map& map, const FieldRect& field);

}  // namespace evigrid::driver
