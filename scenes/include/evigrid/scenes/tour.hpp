// SPDX-License-Identifier: Apache-2.0
// A tour through all of a world's free space, for mapping a plan without writing waypoints by hand.
#pragma once
#include <cstdint>
#include <vector>

#include "evigrid/raycast/world.hpp"

namespace evigrid::scenes {

/// Of the search grid, for bounded time and memory: about 20 bytes each.
inline constexpr std::int64_t kMostTourCells = std::int64_t{1} << 27;

struct TourSpec {
  raycast::Point start{};
  double clearance_m = 0.3;  ///< from every surface, measured exactly; the robot's radius and a margin
  double spacing_m = 2.5;    ///< every reachable place comes within about this distance of the way
  double cell_m = 0.1;       ///< of the search grid; clearance_m where that is smaller
  std::int64_t most_cells = kMostTourCells;
};

/// Waypoints from the start on, straight between them. The waypoints are centres of search cells at least clearance_m
/// from every surface, the legs keep that to 0.3 cells. A gap less than cell_m wider than the robot may be left out,
/// and so is what lies outside the extent of the world (an open world: outside the box of world and start).
/// Deterministic. Throws std::invalid_argument when the start itself is too near to a surface; then what() names the
/// nearest point that is not. Throws std::length_error when the search grid would exceed most_cells.
[[nodiscard]] std::vector<raycast::Point> make_tour(const raycast::World& world, const TourSpec& spec);

/// The roomiest point of the largest region in which a robot can drive, not counting what lies outside all walls where
/// there is an inside; for worlds whose user gives no start. Throws std::invalid_argument when no place has the
/// clearance, std::length_error as above.
[[nodiscard]] raycast::Point find_start(const raycast::World& world, double clearance_m, double cell_m = 0.1,
                                        std::int64_t most_cells = kMostTourCells);

}  // namespace evigrid::scenes
