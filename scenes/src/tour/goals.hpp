// SPDX-License-Identifier: Apache-2.0
// Where a tour has to go, and in which order. Goals: a net over the reachable cells, each cell within spacing of one of
// them by way and any two of them farther apart; roomy places first, so that goals lie in the middle of rooms and
// corridors. Order: nearest unvisited goal, then improved by 2-opt (Croes 1958).
#pragma once
#include <vector>

#include "tour/search.hpp"

namespace evigrid::scenes {

struct Goals {
  std::vector<CellIndex> cells;       ///< cells[0] is the start
  std::vector<std::uint32_t> owner;   ///< per grid cell: number of its nearest goal; kUnreached where none is
  std::vector<std::uint32_t> length;  ///< per grid cell: way to it
};

/// `reachable` lists the cells that can be reached from the start, the start among them.
[[nodiscard]] Goals choose_goals(const DriveGrid& grid, CellIndex start, const std::vector<CellIndex>& reachable,
                                 std::uint32_t spacing);

/// A permutation of the goals that begins with goal 0.
[[nodiscard]] std::vector<std::uint32_t> order_goals(const DriveGrid& grid, const Goals& goals);

}  // namespace evigrid::scenes
