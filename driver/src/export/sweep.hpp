// SPDX-License-Identifier: Apache-2.0
// All seen cells of a map in row-major order, smallest y first, with the planes asked for. Costs the tiles that exist,
// not the rectangle around them: a map may be a thin path through 2^40 cells.
#pragma once
#include <functional>
#include <span>

#include "evigrid/map.hpp"

namespace evigrid::driver {

/// Calls cell(index, values of the layers in their order) for every cell that is not vacuous, and done(tiles, of) after
/// each row of tiles.
void sweep(const Map& map, std::span<const Layer> layers,
           const std::function<void(CellIndex, std::span<const float>)>& cell,
           const std::function<void(std::size_t, std::size_t)>& done);

}  // namespace evigrid::driver
