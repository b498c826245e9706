// SPDX-License-Identifier: Apache-2.0
// How fast a rule believes a change of the world: readings until a cell turns.
#pragma once
#include "evigrid/map.hpp"

namespace evigrid::driver {

inline constexpr int kAgreeingReadings = 20, kMostFlips = 1000;

/// A cell of a map of that rule is told "empty" by `agreeing` readings of m = 0.6, then "occupied" by others of 0.6:
/// how many of these until BetP(occupied) is above ½. kMostFlips: never.
[[nodiscard]] int readings_to_flip(const MapParams& params, int agreeing = kAgreeingReadings);

}  // namespace evigrid::driver
