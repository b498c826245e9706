// SPDX-License-Identifier: Apache-2.0
// Where a simulated run comes from: a scene, by file or name, or a bare world (a floor plan, a mesh, a generated
// building) in which a robot is put and sent on a tour. Shared by `run` and `cast`.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include "cli.hpp"

#include "simulated.hpp"

namespace evigrid::driver {

struct WorldOptions {
  std::string scene;  ///< file or name
  std::string world;  ///< plan, mesh, or "building"
  std::string robot, start;
  std::string up;  ///< of a mesh: "y", "z", or as usual for its format
  std::optional<double> resolution_m, height_m;
  std::optional<std::int64_t> seed;
};

void add_world_options(CLI::App& command, WorldOptions& options);

/// Throws InputError naming the first option given that says how a --world is meant: there is none.
void refuse_world_options(const WorldOptions& options);

/// Throws InputError.
SceneInput open_input(const WorldOptions& options);

}  // namespace evigrid::driver
