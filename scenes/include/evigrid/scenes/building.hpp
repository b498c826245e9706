// SPDX-License-Identifier: Apache-2.0
// A generated building of any size: corridors, rooms with doors, furniture, from a seed. The same on every machine.
#pragma once
#include <cstdint>

#include "evigrid/raycast/world.hpp"

namespace evigrid::scenes {

struct BuildingSpec {
  double width_m = 40, depth_m = 25;  ///< outer size; its lower left corner is at (0, 0). Lengths are taken to 1 mm
  std::uint64_t seed = 1;
  double room_m = 5;  ///< about the side of a room
  double corridor_m = 2.2, door_m = 1.0, wall_m = 0.15;
  double furniture_per_room = 3;  ///< mean count that is tried; small rooms hold less
};

/// Every room can be reached from every other one by doors door_m wide, and nothing stands in front of a door.
/// Throws std::invalid_argument naming the field.
[[nodiscard]] raycast::World make_building(const BuildingSpec& spec);

}  // namespace evigrid::scenes
