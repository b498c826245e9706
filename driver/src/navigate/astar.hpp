// SPDX-License-Identifier: Apache-2.0
// A* on eight neighbours (Hart, Nilsson & Raphael 1968) with the octile distance as heuristic, consistent because no
// factor is below 1. A diagonal step needs both orthogonal neighbours free. Our own and not Boost.Graph's, which
// initialises every vertex for every search (of 4096 × 4096 cells: 0.2 s, where ours costs what it expands) and takes
// 1.7 to 3.5 times as long in large ones: bench/micro/bench_astar.cpp measures both.
#pragma once
#include <cstdint>
#include <vector>

#include "navigate/cost_grid.hpp"
#include "navigate/open_list.hpp"

namespace evigrid::driver {

struct GridPath {
  std::vector<GridCell> cells;  ///< from start to goal, both included; empty: no way
  double length = 0;            ///< in cells
  double cost = 0;              ///< length × factor, summed over the steps
  std::size_t expanded = 0;     ///< cells taken from the open list
  [[nodiscard]] bool found() const { return !cells.empty(); }
};

/// Keeps its memory between searches: a search costs what it expands, whatever the size of the grid.
class Planner {
 public:
  /// The cheapest way. Start and goal may lie in blocked cells only when both are the same. Deterministic.
  [[nodiscard]] GridPath find(const CostGrid& grid, GridCell start, GridCell goal);

 private:
  struct Node {
    double g = 0;
    std::uint32_t search = 0;  // of which search this node is
    std::uint8_t from = 0;     // direction of the step into it
    bool closed = false;
  };
  /// Asks memory for what the expansion of a cell will read.
  void fetch_ahead(const CostGrid& grid, std::uint32_t index) const;
  std::vector<Node> nodes_;
  OpenList open_;
  std::uint32_t search_ = 0;
};

/// Only the cells where the way turns, and its ends.
[[nodiscard]] std::vector<GridCell> corners(const std::vector<GridCell>& path);

}  // namespace evigrid::driver
