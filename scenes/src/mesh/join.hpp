// SPDX-License-Identifier: Apache-2.0
// Many short pieces of straight lines to few long ones.
#pragma once
#include <utility>
#include <vector>

#include "evigrid/raycast/world.hpp"

namespace evigrid::scenes {

using LinePiece = std::pair<raycast::Point, raycast::Point>;

/// End points within `tolerance` of one another become one; pieces that continue one another in a straight line are
/// joined, no end point lying farther than `tolerance` from the long piece that passes it, except where over 256 meet;
/// a piece that comes twice, in whichever direction, is kept once. The answer depends on the set of pieces only, not on
/// their order.
[[nodiscard]] std::vector<LinePiece> join(const std::vector<LinePiece>& pieces, double tolerance);

}  // namespace evigrid::scenes
