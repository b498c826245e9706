// SPDX-License-Identifier: Apache-2.0
// Scan conversion: the cells whose closed square meets a segment or a circle, row by row, in time proportional to their
// number. Coordinates are integers on a lattice of 2^-16 cells, so every decision is exact.
#pragma once
#include <cstdint>
#include <span>

#include "evigrid/scenes/truth.hpp"
#include "truth/outline.hpp"

namespace evigrid::scenes {

/// Surface and free cells only. The grid covers the outline and the points of `include`, and one cell more on every
/// side. Throws std::length_error when it would have more than most_cells; std::invalid_argument for a bad cell_m.
[[nodiscard]] TruthGrid raster(const Outline& outline, double cell_m, std::span<const raycast::Point> include,
                               std::int64_t most_cells);

/// Index of the cell that holds a coordinate, after rounding to the lattice.
[[nodiscard]] std::int64_t cell_of(double coordinate_m, double cell_m);

}  // namespace evigrid::scenes
