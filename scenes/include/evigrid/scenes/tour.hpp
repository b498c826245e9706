// SPDX-License-Identifier: Apache-2.0
// A tour through all of a world's free space, for mapping a plan without writing waypoints by hand.
#pragma once
#include <vector>

#include "evigrid/raycast/world.hpp"

namespace evigrid::scenes {

struct TourSpec {
  raycast::Point start{};
  double clearance_m = 0.3;  ///< from every surface, measured exactly; the robot's radius and a margin
  double spacing_m = 2.5;    ///< every reachable place comes within about this distance of the way
  double cell_m = 0.1;       ///< of the search grid
};

/// Waypoints from the start on, straight between them, none nearer to a surface than clearance_m (cell_m is the
/// tolerance). Deterministic. Throws std::invalid_argument when the start itself is too near to a surface; then what()
/// names the nearest point that is not.
[[nodiscard]] std::vector<raycast::Point> make_tour(const raycast::World& world, const TourSpec& spec);

/// The point of the largest clearance reachable region, for worlds whose user gives no start. Throws
/// std::invalid_argument when no place has the clearance.
[[nodiscard]] raycast::Point find_start(const raycast::World& world, double clearance_m, double cell_m = 0.1);

}  // namespace evigrid::scenes
