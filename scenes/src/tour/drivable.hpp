// SPDX-License-Identifier: Apache-2.0
// The search grid of a tour: the cells on whose centre a robot can stand, and the regions they make. Lengths of ways
// are integers, 1000 for a straight step and 1414 for a diagonal one: the same on every machine.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "tour/nearby.hpp"

namespace evigrid::scenes {

using CellIndex = std::uint32_t;
inline constexpr std::uint32_t kStraight = 1000, kDiagonal = 1414;
inline constexpr std::uint32_t kUnreached = 0xffffffffu;

/// A way too long to be told (4 million cells) counts as none.
[[nodiscard]] inline std::uint32_t sum(std::uint32_t a, std::uint32_t b) {
  return a > kUnreached - b ? kUnreached : a + b;
}

struct DriveGrid {
  std::int64_t x = 0, y = 0, width = 0, height = 0;
  double cell_m = 0;
  std::vector<std::uint8_t> drivable;       ///< exact: the centre's distance to every surface ≥ clearance_m
  std::vector<std::uint32_t> clearance_sq;  ///< in cells, between cell centres: within 0.71 cells of the exact one
  /// A straight step between neighbouring drivable centres keeps at least this; legs are held to it. It is less than
  /// clearance_m by at most 0.3 cells, since cell_m ≤ clearance_m.
  double leg_clearance_m = 0;

  [[nodiscard]] raycast::Point centre(CellIndex i) const {
    return {(static_cast<double>(x + i % width) + 0.5) * cell_m, (static_cast<double>(y + i / width) + 0.5) * cell_m};
  }
};

/// Cells of the rim are never drivable. cell_m larger than clearance_m is made as small. Throws std::length_error and
/// std::invalid_argument.
[[nodiscard]] DriveGrid drive_grid(const Outline& outline, const Nearby& nearby, double clearance_m, double cell_m,
                                   std::span<const raycast::Point> include, std::int64_t most_cells);

struct Step {
  std::int64_t offset;
  std::uint32_t length;
};
[[nodiscard]] std::vector<Step> steps(const DriveGrid& grid);

/// The largest connected region of drivable cells that does not touch the rim of the grid; the largest one that does
/// when it has more than eight times as many. Marks its cells with 1; all 0 when nothing is drivable.
[[nodiscard]] std::vector<std::uint8_t> main_region(const DriveGrid& grid);

}  // namespace evigrid::scenes
