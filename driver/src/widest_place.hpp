// SPDX-License-Identifier: Apache-2.0
// Where to put a robot in a floor plan whose user does not say: outlines alone do not tell room from solid wall, the
// plan's cells do.
#pragma once
#include <optional>

#include "evigrid/scenes/plan.hpp"

namespace evigrid::driver {

/// The middle of the free pixel that is farthest from everything else, in the map frame. Pixels that are joined to the
/// image's border through free ones are the last resort: often they are the world outside of the building.
/// `clearance_m`: what it should have at least. Nothing when no pixel is free.
std::optional<raycast::Point> widest_place(const scenes::FloorPlan& plan, double clearance_m);

}  // namespace evigrid::driver
