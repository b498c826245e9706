// SPDX-License-Identifier: Apache-2.0
// Shortest ways on the search grid: Dijkstra spreading from many cells, and A* from one cell to another.
#pragma once
#include <vector>

#include "tour/drivable.hpp"

namespace evigrid::scenes {

/// A cell and the length of the way to it. Ties go by the cell's number: the order is the same everywhere.
struct Front {
  std::uint32_t length;
  CellIndex cell;
  friend bool operator>(const Front& a, const Front& b) {
    return a.length != b.length ? a.length > b.length : a.cell > b.cell;
  }
};

class Spread {
 public:
  explicit Spread(const DriveGrid& grid) : grid_(&grid), steps_(steps(grid)) {}

  /// Lowers length[] to the shortest way from any of `sources` (at 0), but only where it is at most `farthest` and
  /// shorter than what is there. Calls changed(cell) after each such change.
  template <class Changed>
  void run(const std::vector<CellIndex>& sources, std::uint32_t farthest, std::vector<std::uint32_t>& length,
           Changed changed);

 private:
  const DriveGrid* grid_;
  std::vector<Step> steps_;
  std::vector<Front> heap_;
};

class Pathfinder {
 public:
  explicit Pathfinder(const DriveGrid& grid);

  /// Cells from `from` to `to`, both included; empty when there is no way.
  [[nodiscard]] std::vector<CellIndex> path(CellIndex from, CellIndex to);

 private:
  const DriveGrid* grid_;
  std::vector<Step> steps_;
  std::vector<std::uint32_t> length_, run_;  // length_[i] is of this search where run_[i] == runs_
  std::uint32_t runs_ = 0;
  struct Open {
    std::uint32_t total, length;
    CellIndex cell;
  };
  std::vector<Open> heap_;
};

}  // namespace evigrid::scenes

#include "tour/spread.inl.hpp"
