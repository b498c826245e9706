// SPDX-License-Identifier: Apache-2.0
#include "navigate/astar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace evigrid::driver {
namespace {

constexpr std::array<GridCell, 8> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
constexpr std::uint8_t kStart = 8;
constexpr double kDiagonal = std::numbers::sqrt2;

double octile(GridCell a, GridCell b) {
  const int dx = std::abs(a.x - b.x), dy = std::abs(a.y - b.y);
  return std::max(dx, dy) + (kDiagonal - 1) * std::min(dx, dy);
}

/// The eight cells around one: kBlocked where no step leads.
struct Around {
  std::array<float, 8> cost;
  std::array<std::size_t, 8> index;
};

Around look_around(const CostGrid& grid, GridCell at, std::size_t index) {
  Around out{};
  const bool inner = at.x > 0 && at.y > 0 && at.x < grid.width - 1 && at.y < grid.height - 1;
  for (std::size_t d = 0; d < 8; ++d) {
    const GridCell to{at.x + kSteps[d].x, at.y + kSteps[d].y};
    out.index[d] = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(index) + kSteps[d].x +
                                            static_cast<std::ptrdiff_t>(kSteps[d].y) * grid.width);
    out.cost[d] = inner || grid.inside(to) ? grid.cost[out.index[d]] : kBlocked;
  }
  for (std::size_t d = 4; d < 8; ++d) {
    if (out.cost[d - 4] == kBlocked || out.cost[(d - 3) % 4] == kBlocked) out.cost[d] = kBlocked;
  }
  return out;
}

}  // namespace

void Planner::fetch_ahead(const CostGrid& grid, std::uint32_t index) const {
  const auto row = static_cast<std::uintptr_t>(grid.width);
  for (const std::uintptr_t back : {std::uintptr_t{0}, row, 0 - row}) {  // addresses alone: none is read
    const std::uintptr_t i = index - back;
    __builtin_prefetch(
        reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(nodes_.data()) + i * sizeof(Node)));
    __builtin_prefetch(
        reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(grid.cost.data()) + i * sizeof(float)));
  }
}

GridPath Planner::find(const CostGrid& grid, GridCell start, GridCell goal) {
  GridPath path;
  if (!grid.inside(start) || !grid.inside(goal)) return path;
  if (start == goal) {
    path.cells = {start};
    return path;
  }
  if (!grid.free(start) || !grid.free(goal)) return path;
  if (nodes_.size() < grid.cost.size()) nodes_.resize(grid.cost.size());
  if (++search_ == 0) {  // the counter went round: forget all searches
    std::fill(nodes_.begin(), nodes_.end(), Node{});
    search_ = 1;
  }
  open_.clear();
  nodes_[grid.index(start)] = {0, search_, kStart, false};
  open_.push({octile(start, goal), 0, static_cast<std::uint32_t>(grid.index(start))});
  const std::size_t target = grid.index(goal);
  while (!open_.empty()) {
    const OpenList::Item top = open_.pop();
    if (const OpenList::Item* soon = open_.peek()) fetch_ahead(grid, soon->index);
    Node& node = nodes_[top.index];
    if (node.closed || top.g != node.g) continue;  // a better way came since
    node.closed = true;
    ++path.expanded;
    if (top.index == target) break;
    const GridCell at = grid.cell(top.index);
    const Around around = look_around(grid, at, top.index);
    for (std::uint8_t d = 0; d < 8; ++d) {
      if (around.cost[d] == kBlocked) continue;
      const std::size_t index = around.index[d];
      const double g = top.g + (d < 4 ? 1.0 : kDiagonal) * static_cast<double>(around.cost[d]);
      Node& next = nodes_[index];
      if (next.search == search_ && (next.closed || next.g <= g)) continue;
      next = {g, search_, d, false};
      open_.push({g + octile({at.x + kSteps[d].x, at.y + kSteps[d].y}, goal), g, static_cast<std::uint32_t>(index)});
    }
  }
  if (nodes_[target].search != search_ || !nodes_[target].closed) return path;
  path.cost = nodes_[target].g;
  GridCell at = goal;
  for (;;) {
    path.cells.push_back(at);
    const std::uint8_t d = nodes_[grid.index(at)].from;
    if (d == kStart) break;
    path.length += d < 4 ? 1.0 : kDiagonal;
    at = {at.x - kSteps[d].x, at.y - kSteps[d].y};
  }
  std::reverse(path.cells.begin(), path.cells.end());
  return path;
}

std::vector<GridCell> corners(const std::vector<GridCell>& path) {
  std::vector<GridCell> out;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const bool end = i == 0 || i + 1 == path.size();
    if (end || path[i].x - path[i - 1].x != path[i + 1].x - path[i].x ||
        path[i].y - path[i - 1].y != path[i + 1].y - path[i].y) {
      out.push_back(path[i]);
    }
  }
  return out;
}

}  // namespace evigrid::driver
