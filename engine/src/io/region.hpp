// SPDX-License-Identifier: Apache-2.0
// A part of a saved map: which tiles of the directory are read for it, and what of them does not belong to it.
#pragma once
#include <span>
#include <vector>

#include "evigrid/map.hpp"
#include "io/layout.hpp"

namespace evigrid::io {

/// Leaves the tiles that meet the region, in their order; none for an empty one.
void keep_region(std::vector<Entry>& entries, const CellRect& region);
/// Forgets the cells of those tiles that lie outside.
void clear_around(Map& map, std::span<const Entry> entries, const CellRect& region);

}  // namespace evigrid::io
