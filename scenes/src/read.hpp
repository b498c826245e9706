// SPDX-License-Identifier: Apache-2.0
// The parts of a scene file, each read by its own function.
#pragma once
#include <vector>

#include "document.hpp"
#include "evigrid/scenes/scene.hpp"

namespace evigrid::scenes {

/// [material.NAME] and [world].
raycast::World read_world(Table& root);

/// [robot.sensor] (defaults), [robot.ring] and [[robot.sonar]].
std::vector<SonarSpec> read_robot(Table robot);

}  // namespace evigrid::scenes
