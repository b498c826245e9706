// SPDX-License-Identifier: Apache-2.0
// A tool room drawn at random: 33 feet square with a doorway, full of boxes, a free floor in its middle. For asking
// whether an outcome is the behaviour's or one made-up room's.
#pragma once
#include <cstdint>

#include "evigrid/raycast/world.hpp"

namespace evigrid::driver {

/// Middle (5, 5) m; nothing stands within `free_m` of it. Deterministic.
[[nodiscard]] raycast::World cluttered_room(std::uint64_t seed, double free_m);

}  // namespace evigrid::driver
