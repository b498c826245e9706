// SPDX-License-Identifier: Apache-2.0
// What a map got right and wrong: its decided cells over the true world.
#pragma once
#include <string>

#include "picture/canvas.hpp"
#include "score/score.hpp"

namespace evigrid::driver {

/// Throws InputError naming truth.png when it would be larger than `cap_mb`.
[[nodiscard]] Canvas draw_truth(const Overlay& overlay, const Score& score, double cell_m, const std::string& name,
                                int cap_mb);

}  // namespace evigrid::driver
