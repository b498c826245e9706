// SPDX-License-Identifier: Apache-2.0
// Exact Euclidean distance transform in linear time: Meijster, Roerdink, Hesselink, "A general algorithm for computing
// distance transforms in linear time" (2000). Integers only. Unit: cells, between cell centres.
#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "evigrid/scenes/truth.hpp"

namespace evigrid::scenes {

/// Stands for every squared distance that is as large or larger, and for "there is no surface".
inline constexpr std::uint32_t kFarAway = std::numeric_limits<std::uint32_t>::max();

/// Squared distance of every cell to the nearest surface cell, row-major as grid.cells.
[[nodiscard]] std::vector<std::uint32_t> squared_distance(const TruthGrid& grid);

}  // namespace evigrid::scenes
