// SPDX-License-Identifier: Apache-2.0
// What the sonars of a robot hear at one moment, or at several: their own first echoes; when the scene asks for it,
// also echoes by way of a second surface and the echoes of other sonars that ping at the same moment.
#pragma once
#include <span>

#include "evigrid/raycast/scene.hpp"
#include "evigrid/scenes/scene.hpp"

namespace evigrid::scenes {

/// `cones` holds whole steps: one query per sonar of the scene, again and again. echoes[i] answers cones[i].
void hear(const raycast::Scene& caster, const Scene& scene, std::span<const raycast::ConeQuery> cones,
          std::span<raycast::Echo> echoes, raycast::Scene::Placements movers);

}  // namespace evigrid::scenes
