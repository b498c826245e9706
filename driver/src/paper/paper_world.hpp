// SPDX-License-Identifier: Apache-2.0
// Where a paper's behaviour runs: the paper's own scene, or the paper's robot in a floor plan of the user's.
#pragma once
#include <memory>

#include "evigrid/raycast/scene.hpp"
#include "evigrid/scenes/fleet.hpp"
#include "evigrid/scenes/scene.hpp"
#include "paper/paper.hpp"

namespace evigrid::driver {

struct PaperWorld {
  scenes::Scene scene;
  std::unique_ptr<scenes::Floor> floor;  ///< where a robot can stand and drive
  std::unique_ptr<raycast::Scene> caster;
  explicit PaperWorld(scenes::Scene s);
};

/// @param scene, robot names of embedded ones; the robot counts in a plan of the user's alone, where it gets a tour
/// through all that it can reach, and cells as the paper's. The seed is the user's where one is given.
/// Throws InputError.
[[nodiscard]] scenes::Scene paper_scene(const PaperOptions& options, const char* scene, const char* robot);

/// All that stands is of one material that throws sound away beyond this angle to its normal.
void cover_all(raycast::World& world, double critical_incidence_deg);

}  // namespace evigrid::driver
