// SPDX-License-Identifier: Apache-2.0
// The world as cells: what a perfect map would say. For scoring maps and for finding where a robot can drive.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "evigrid/raycast/world.hpp"

namespace evigrid::scenes {

/// surface: a wall passes through the (closed) cell; solid: inside a closed outline, no sensor can see it; free:
/// neither.
enum class TruthCell : std::uint8_t { free, surface, solid };

struct TruthGrid {
  std::int64_t x = 0, y = 0;  ///< index of the lower left cell; cell (ix, iy) covers [ix·c, (ix+1)·c] × ...
  std::int64_t width = 0, height = 0;
  double cell_m = 0;
  std::vector<TruthCell> cells;  ///< row-major, row 0 at the bottom

  [[nodiscard]] TruthCell at(std::int64_t ix, std::int64_t iy) const {
    return cells[static_cast<std::size_t>((iy - y) * width + (ix - x))];
  }
};

/// Covers the extent of the world and `inside`, and one cell more on every side. Solid is what cannot be reached from
/// `inside` (a point in free space, e.g. the robot's start) without crossing a surface cell; in an open world the free
/// space runs to the rim of the grid.
///
/// Coordinates are rounded to 2^-16 of a cell, as the engine does; on this lattice the cells are exact. So a wall
/// meant to lie on a border of cells does, and both neighbours are surface.
///
/// Throws std::length_error when the grid would exceed 2^31 cells, std::invalid_argument when a number of the world is
/// not finite (naming the object) or `inside` lies in a surface cell.
[[nodiscard]] TruthGrid rasterise(const raycast::World& world, double cell_m, raycast::Point inside);

/// The first of some points whose cell holds no surface, the world rasterised once for all of them. Throws
/// std::length_error as above.
[[nodiscard]] std::optional<raycast::Point> first_off_surfaces(const raycast::World& world, double cell_m,
                                                               std::span<const raycast::Point> points);

/// Bounding box of all surfaces, the corners with the least and the greatest coordinates. Empty world: both (0, 0).
struct Extent {
  raycast::Point low{}, high{};
};
[[nodiscard]] Extent extent(const raycast::World& world);

}  // namespace evigrid::scenes
