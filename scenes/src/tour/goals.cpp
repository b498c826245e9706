// SPDX-License-Identifier: Apache-2.0
#include "tour/goals.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

namespace evigrid::scenes {
namespace {

constexpr std::size_t kMostForMatrix = 2500;  // goals; beyond, no 2-opt: its table grows with the square
constexpr int kMostSweeps = 50;

/// Ways between neighbouring goals: those whose areas touch.
struct Edge {
  std::uint32_t a, b, length;
};

class GoalGraph {
 public:
  GoalGraph(const DriveGrid& grid, const Goals& goals) : begin_(goals.cells.size() + 1, 0) {
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < goals.owner.size(); ++i) {
      if (goals.owner[i] == kUnreached) continue;
      for (const Step& step : steps(grid)) {
        const std::size_t j = i + static_cast<std::size_t>(step.offset);
        if (goals.owner[j] == kUnreached || goals.owner[j] == goals.owner[i]) continue;
        edges.push_back({goals.owner[i], goals.owner[j], sum(sum(goals.length[i], step.length), goals.length[j])});
      }
    }
    std::sort(edges.begin(), edges.end(),
              [](const Edge& p, const Edge& q) { return std::tie(p.a, p.b, p.length) < std::tie(q.a, q.b, q.length); });
    const auto same = [](const Edge& p, const Edge& q) { return p.a == q.a && p.b == q.b; };
    edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
    for (const Edge& e : edges) ++begin_[e.a + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    edges_ = std::move(edges);
  }

  /// Visits goals in the order of their distance from `from` until visit(goal, length) answers true.
  template <class Visit>
  void spread(std::uint32_t from, Visit visit) {
    length_.resize(begin_.size() - 1, kUnreached);
    for (const std::uint32_t goal : touched_) length_[goal] = kUnreached;  // of the last call: far fewer than all
    touched_.assign(1, from);
    std::priority_queue<Front, std::vector<Front>, std::greater<>> open;
    length_[from] = 0;
    open.push({0, from});
    while (!open.empty()) {
      const Front front = open.top();
      open.pop();
      if (front.length > length_[front.cell]) continue;
      if (visit(front.cell, front.length)) return;
      for (std::size_t k = begin_[front.cell]; k < begin_[front.cell + 1]; ++k) {
        const std::uint32_t length = sum(front.length, edges_[k].length);
        if (length >= length_[edges_[k].b]) continue;
        if (length_[edges_[k].b] == kUnreached) touched_.push_back(edges_[k].b);
        length_[edges_[k].b] = length;
        open.push({length, edges_[k].b});
      }
    }
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> length_, touched_;  // touched_: goals whose length_ is not kUnreached
};

std::vector<std::uint32_t> nearest_first(GoalGraph& graph, std::size_t count) {
  std::vector<std::uint8_t> visited(count, 0);
  std::vector<std::uint32_t> order{0};
  visited[0] = 1;
  while (order.size() < count) {
    std::uint32_t next = 0;
    graph.spread(order.back(), [&](std::uint32_t goal, std::uint32_t) { return next = goal, !visited[goal]; });
    visited[next] = 1;
    order.push_back(next);
  }
  return order;
}

/// Turns pieces of an open tour round as long as it gets shorter; its first goal stays.
void two_opt(std::vector<std::uint32_t>& order, const std::vector<std::uint32_t>& matrix) {
  const std::size_t n = order.size();
  const auto way = [&](std::size_t i, std::size_t j) { return std::int64_t{matrix[order[i] * n + order[j]]}; };
  bool better = true;
  for (int sweep = 0; better && sweep < kMostSweeps; ++sweep) {
    better = false;
    for (std::size_t i = 1; i + 1 < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) {
        const std::int64_t before = way(i - 1, i) + (j + 1 < n ? way(j, j + 1) : 0);
        const std::int64_t after = way(i - 1, j) + (j + 1 < n ? way(i, j + 1) : 0);
        if (after >= before) continue;
        std::reverse(order.begin() + static_cast<std::ptrdiff_t>(i),
                     order.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        better = true;
      }
    }
  }
}

}  // namespace

Goals choose_goals(const DriveGrid& grid, CellIndex start, const std::vector<CellIndex>& reachable,
                   std::uint32_t spacing) {
  std::vector<CellIndex> order = reachable;
  std::sort(order.begin(), order.end(), [&](CellIndex a, CellIndex b) {
    return grid.clearance_sq[a] != grid.clearance_sq[b] ? grid.clearance_sq[a] > grid.clearance_sq[b] : a < b;
  });
  Goals goals;
  goals.owner.assign(grid.drivable.size(), kUnreached);
  goals.length.assign(grid.drivable.size(), kUnreached);
  Spread spread(grid);
  const auto add = [&](CellIndex cell) {
    const auto number = static_cast<std::uint32_t>(goals.cells.size());
    goals.cells.push_back(cell);
    spread.run({cell}, spacing, goals.length, [&](CellIndex c) { goals.owner[c] = number; });
  };
  add(start);
  for (const CellIndex cell : order)
    if (goals.length[cell] == kUnreached) add(cell);
  return goals;
}

std::vector<std::uint32_t> order_goals(const DriveGrid& grid, const Goals& goals) {
  const std::size_t n = goals.cells.size();
  GoalGraph graph(grid, goals);
  std::vector<std::uint32_t> order = nearest_first(graph, n);
  if (n > kMostForMatrix) return order;
  std::vector<std::uint32_t> matrix(n * n);
  for (std::uint32_t a = 0; a < n; ++a)
    graph.spread(a, [&](std::uint32_t b, std::uint32_t length) { return matrix[a * n + b] = length, false; });
  two_opt(order, matrix);
  return order;
}

}  // namespace evigrid::scenes
