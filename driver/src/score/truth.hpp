// SPDX-License-Identifier: Apache-2.0
// What a perfect map of a scene's world would hold; movers are left out, they are not where they were.
#pragma once
#include <optional>
#include <string>

#include "evigrid/scenes/scene.hpp"
#include "evigrid/scenes/truth.hpp"

namespace evigrid::driver {

struct SceneTruth {
  std::optional<scenes::TruthGrid> grid;
  std::string why_not;  ///< when there is none: too large a world, or cells so coarse that walls pass through all of the way
};
/// Free is what the robot could reach from its way.
[[nodiscard]] SceneTruth scene_truth(const scenes::Scene& scene, double cell_m);

}  // namespace evigrid::driver
