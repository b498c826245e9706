// SPDX-License-Identifier: Apache-2.0
#include "score/truth.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "error.hpp"
#include "evigrid/scenes/simulate.hpp"

namespace evigrid::driver {

scenes::TruthGrid scene_truth(const scenes::Scene& scene, double cell_m) {
  try {
    std::string why;
    for (const scenes::Pose& pose : scenes::drive(scene.trajectory)) {  // a coarse cell may hold the start and a wall
      try {
        return scenes::rasterise(scene.world, cell_m, {pose.x_m, pose.y_m});
      } catch (const std::invalid_argument& in_wall) {
        why = in_wall.what();
      }
    }
    throw InputError(fmt::format("{}: no truth at cells of {:g} m: {}", scene.name, cell_m, why));
  } catch (const std::length_error& large) {
    throw InputError(fmt::format("{}: no truth at cells of {:g} m: {}", scene.name, cell_m, large.what()));
  }
}

}  // namespace evigrid::driver
