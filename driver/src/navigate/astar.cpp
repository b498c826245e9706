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

}  // namespace

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
  // Of equal f the larger g first: it is nearer to the goal; then the lower index, so that the way is repeatable.
  const auto later = [](const Open& a, const Open& b) {
    return a.f != b.f ? a.f > b.f : a.g != b.g ? a.g < b.g : a.index > b.index;
  };
  heap_.clear();
  const auto push = [&](double f, double g, std::size_t index) {
    heap_.push_back({f, g, static_cast<std::uint32_t>(index)});
    std::push_heap(heap_.begin(), heap_.end(), later);
  };
  nodes_[grid.index(start)] = {0, search_, kStart, false};
  push(octile(start, goal), 0, grid.index(start));
  const std::size_t target = grid.index(goal);
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), later);
    const Open top = heap_.back();
    heap_.pop_back();
    Node& node = nodes_[top.index];
    if (node.closed || top.g != node.g) continue;  // a better way came since
    node.closed = true;
    ++path.expanded;
    if (top.index == target) break;
    const GridCell at = grid.cell(top.index);
    std::array<bool, 8> open{};
    for (std::uint8_t d = 0; d < 4; ++d) open[d] = grid.free({at.x + kSteps[d].x, at.y + kSteps[d].y});
    for (std::uint8_t d = 4; d < 8; ++d) {
      const std::size_t one = d - 4U, other = (d - 3U) % 4;
      open[d] = open[one] && open[other] && grid.free({at.x + kSteps[d].x, at.y + kSteps[d].y});
    }
    for (std::uint8_t d = 0; d < 8; ++d) {
      if (!open[d]) continue;
      const GridCell to{at.x + kSteps[d].x, at.y + kSteps[d].y};
      const std::size_t index = grid.index(to);
      const double g = top.g + (d < 4 ? 1.0 : kDiagonal) * static_cast<double>(grid.cost[index]);
      Node& next = nodes_[index];
      if (next.search == search_ && (next.closed || next.g <= g)) continue;
      next = {g, search_, d, false};
      push(g + octile(to, goal), g, index);
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
