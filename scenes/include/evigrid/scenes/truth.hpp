// SPDX-License-Identifier: Apache-2.0
// The world as cells: what a perfect map would say. For scoring maps and for finding where a robot can drive.
#pragma once
#include <cstdint>
#include <vector>

#include "evigrid/raycast/world.hpp"

namespace evigrid::scenes {

/// surface: a wall passes through the (closed) cell; solid: inside a closed outline, no sensor can see it; free: neither.
enum class TruthCell : std::uint8_t { free, surface, solid };

struct TruthGrid {
  std::int64_t x = 0, y = 0;           ///< index of the lower left cell; cell (ix, iy) covers [ix·c, (ix+1)·c) × ...
  std::int64_t width = 0, height = 0;
  double cell_m = 0;
  std::vector<TruthCell> cells;        ///< row-major, row 0 at the bottom

  [[nodiscard]] TruthCell at(std::int64_t ix, std::int64_t iy) const {
    return cells[static_cast<std::size_t>((iy - y) * width + (ix - x))];
  }
};

/// Solid is what cannot be reached from `inside` (a point in free space, e.g. the robot's start) without crossing a
/// surface cell. Throws std::length_error when the grid would exceed 2^31 cells.
[[nodiscard]] TruthGrid rasterise(const raycast::World& world, double cell_m, raycast::Point inside);

/// Bounding box of all surfaces, the corners with the least and the greatest coordinates. Empty world: both (0, 0).
struct Extent {
  raycast::Point low{}, high{};
};
[[nodiscard]] Extent extent(const raycast::World& world);

}  // namespace evigrid::scenes
