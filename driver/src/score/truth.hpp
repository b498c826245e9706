// SPDX-License-Identifier: Apache-2.0
// What a perfect map of a scene's world would hold; movers are left out, they are not where they were.
#pragma once
#include "evigrid/scenes/scene.hpp"
#include "evigrid/scenes/truth.hpp"

namespace evigrid::driver {

/// Free is what the robot could reach from its way. Throws InputError when the grid would be too large, or the whole
/// way lies in cells that a wall passes through.
[[nodiscard]] scenes::TruthGrid scene_truth(const scenes::Scene& scene, double cell_m);

}  // namespace evigrid::driver
