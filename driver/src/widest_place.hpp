// SPDX-License-Identifier: Apache-2.0
// Where to put a robot in a floor plan whose user does not say: outlines alone do not tell room from solid wall, the
// plan's cells do.
#pragma once
#include <optional>

#include "evigrid/scenes/plan.hpp"

namespace evigrid::driver {

/// The middle of the widest free pixel of the largest region in which a robot that needs `clearance_m` has room, in the
/// map frame. Regions that are joined to the image's border are taken only when they are far larger: often they are the
/// world outside of the building. Without any room: the widest free pixel. Nothing when no pixel is free.
std::optional<raycast::Point> widest_place(const scenes::FloorPlan& plan, double clearance_m);

}  // namespace evigrid::driver
