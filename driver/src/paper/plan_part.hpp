// SPDX-License-Identifier: Apache-2.0
// The part of a user's building that a robot can sense from a stretch of way: behaviours that stay near one place need
// no map, no truth and no caster of all the rest.
#pragma once
#include <array>
#include <vector>

#include "evigrid/raycast/world.hpp"

namespace evigrid::driver {

/// Corners of a box, anticlockwise.
[[nodiscard]] std::array<raycast::Point, 4> corners(const raycast::Box& box);

/// Surfaces within the box around `way` that is wider than it by `reach_m` on every side, cut off at its sides, and the
/// box itself as a wall: it is out of reach, and encloses what is free. Outlines and boxes become walls; circles that
/// reach into the box stay whole, the box then grows around them.
/// @param way at least one point, m in the map frame.
[[nodiscard]] raycast::World part_around(const raycast::World& world, const std::vector<raycast::Point>& way,
                                         double reach_m);

}  // namespace evigrid::driver
