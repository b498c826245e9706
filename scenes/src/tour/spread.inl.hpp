// SPDX-License-Identifier: Apache-2.0
// The body of Spread::run (search.hpp).
#pragma once
#include <algorithm>
#include <functional>

namespace evigrid::scenes {

template <class Changed>
void Spread::run(const std::vector<CellIndex>& sources, std::uint32_t farthest, std::vector<std::uint32_t>& length,
                 Changed changed) {
  const auto reach = [&](CellIndex cell, std::uint32_t way) {
    if (way > farthest || way >= length[cell]) return;
    length[cell] = way;
    changed(cell);
    heap_.push_back({way, cell});
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>{});
  };
  for (const CellIndex cell : sources) reach(cell, 0);
  while (!heap_.empty()) {
    const Front front = heap_.front();
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>{});
    heap_.pop_back();
    if (front.length > length[front.cell]) continue;
    for (const Step& step : steps_) {
      const auto next = static_cast<CellIndex>(front.cell + step.offset);
      if (grid_->drivable[next]) reach(next, sum(front.length, step.length));
    }
  }
}

}  // namespace evigrid::scenes
