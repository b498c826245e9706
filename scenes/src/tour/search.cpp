// SPDX-License-Identifier: Apache-2.0
#include "tour/search.hpp"

#include <cstdlib>

namespace evigrid::scenes {

Pathfinder::Pathfinder(const DriveGrid& grid)
    : grid_(&grid), steps_(steps(grid)), length_(grid.drivable.size()), run_(grid.drivable.size()) {}

std::vector<CellIndex> Pathfinder::path(CellIndex from, CellIndex to) {
  ++runs_;
  heap_.clear();
  const std::int64_t w = grid_->width, to_x = to % w, to_y = to / w;
  const auto later = [](const Open& a, const Open& b) {  // ties: the one that has come farther, then by number
    if (a.total != b.total) return a.total > b.total;
    return a.length != b.length ? a.length < b.length : a.cell > b.cell;
  };
  const auto reach = [&](CellIndex cell, std::uint32_t length) {
    if (length == kUnreached || (run_[cell] == runs_ && length >= length_[cell])) return;
    run_[cell] = runs_;
    length_[cell] = length;
    const std::int64_t dx = std::abs(cell % w - to_x), dy = std::abs(cell / w - to_y);  // octile distance
    const auto rest = static_cast<std::uint32_t>(
        std::min<std::int64_t>(std::min(dx, dy) * kDiagonal + std::abs(dx - dy) * kStraight, kUnreached));
    heap_.push_back({sum(length, rest), length, cell});
    std::push_heap(heap_.begin(), heap_.end(), later);
  };
  reach(from, 0);
  while (!heap_.empty()) {
    const Open open = heap_.front();
    if (open.cell == to) break;
    std::pop_heap(heap_.begin(), heap_.end(), later);
    heap_.pop_back();
    if (open.length > length_[open.cell]) continue;
    for (const Step& step : steps_) {
      const auto next = static_cast<CellIndex>(open.cell + step.offset);
      if (grid_->drivable[next]) reach(next, sum(open.length, step.length));
    }
  }
  if (heap_.empty()) return {};
  std::vector<CellIndex> path{to};
  while (path.back() != from) {  // back along any step that explains the length
    for (const Step& step : steps_) {
      const auto before = static_cast<CellIndex>(path.back() + step.offset);
      if (!grid_->drivable[before] || run_[before] != runs_) continue;
      if (sum(length_[before], step.length) > length_[path.back()]) continue;
      path.push_back(before);
      break;
    }
  }
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace evigrid::scenes
