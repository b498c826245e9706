// SPDX-License-Identifier: Apache-2.0
// Furniture of one room: desks, cabinets, sofas, round tables, chairs, pots. Nothing stands in front of a door, and in
// a room with several doors a lane as wide as a door leads from each to the middle.
#pragma once
#include "building/layout.hpp"

namespace evigrid::scenes {

enum class Stuff : std::uint8_t { wood, cloth, metal };

struct Piece {
  Rect rect;  ///< of a box; of a round piece its bounding square
  bool round = false;
  int yaw_deg = 0;  ///< of a box about its centre
  Stuff stuff = Stuff::wood;
};

[[nodiscard]] std::vector<Piece> furnish(const Room& room, const Measures& measures, double mean_count, Draws draws);

}  // namespace evigrid::scenes
