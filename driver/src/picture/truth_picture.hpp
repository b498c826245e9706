// SPDX-License-Identifier: Apache-2.0
// What a map got right and wrong: its decided cells over the true world.
#pragma once
#include <string>

#include "evigrid/scenes/truth.hpp"
#include "out/layers.hpp"
#include "picture/canvas.hpp"

namespace evigrid::driver {

/// Throws InputError naming truth.png when it would be larger than `cap_mb`.
[[nodiscard]] Canvas draw_truth(const Layers& map, const scenes::TruthGrid& truth, const std::string& name, int cap_mb);

}  // namespace evigrid::driver
