// SPDX-License-Identifier: Apache-2.0
// A scene driven and cast: the same Log that a recording gives, so `run` maps it the same way.
#pragma once
#include <string>

#include "evigrid/scenes/scene.hpp"
#include "log/log.hpp"

namespace evigrid::driver {

struct SceneInput {
  std::string name;  ///< the file, or "(embedded scene)"
  scenes::Scene scene;
};

/// An empty path means the embedded scene. Throws InputError naming file, line and field.
SceneInput open_scene(const std::string& path);

struct Simulated {
  Log log;
  double cast_s = 0;  ///< building the caster and casting every reading
};

/// @param no_noise casts the true ranges instead, for `cast --truth`.
Simulated simulate(const scenes::Scene& scene, bool no_noise = false);

}  // namespace evigrid::driver
