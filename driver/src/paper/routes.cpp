// SPDX-License-Identifier: Apache-2.0
#include "paper/routes.hpp"

#include <algorithm>
#include <cmath>

#include "evigrid/scenes/truth.hpp"
#include "navigate/distance_transform.hpp"

namespace evigrid::driver {
namespace {

constexpr double kMostCells = 1 << 24;  // of the fine raster: some tenths of a second

/// The largest odd number of fine cells on a side of a cell, so that its centre is the centre of one of them.
int fineness(const CellRect& rect) {
  for (const int n : {9, 7, 5, 3}) {
    if (static_cast<double>(rect.width) * static_cast<double>(rect.height) * n * n <= kMostCells) return n;
  }
  return 1;
}

}  // namespace

std::vector<float> occupancy(const Layers& l) {
  std::vector<float> m(l.cells());
  for (std::size_t i = 0; i < m.size(); ++i) m[i] = std::max(1 - l.e()[i], l.o()[i]);
  return m;
}

CostGrid cost_grid(const Layers& l, const std::vector<float>& m, const StepCost& cost) {
  CostGrid grid(static_cast<int>(l.rect.width), static_cast<int>(l.rect.height));
  for (std::size_t i = 0; i < m.size(); ++i) {
    const double v = m[i];
    grid.cost[i] = v > cost.blocked_above ? kBlocked : static_cast<float>(1 + cost.weight * v);
  }
  return grid;
}

Clearance::Clearance(const raycast::World& world, const CellRect& rect, double cell_m, raycast::Point inside)
    : width_(static_cast<int>(rect.width)), cell_m_(cell_m) {
  const int n = fineness(rect);
  fine_m_ = cell_m / n;
  const scenes::TruthGrid truth = scenes::rasterise(world, fine_m_, inside);
  std::vector<std::uint8_t> marked(truth.cells.size());
  std::transform(truth.cells.begin(), truth.cells.end(), marked.begin(),
                 [](scenes::TruthCell c) { return c != scenes::TruthCell::free; });
  const auto squares = squared_distances(marked, static_cast<int>(truth.width), static_cast<int>(truth.height));
  clearance_m_.reserve(static_cast<std::size_t>(rect.width * rect.height));
  for (std::int64_t y = rect.y; y < rect.y + rect.height; ++y) {
    for (std::int64_t x = rect.x; x < rect.x + rect.width; ++x) {
      const std::int64_t fx = std::clamp<std::int64_t>(n * x + n / 2 - truth.x, 0, truth.width - 1);
      const std::int64_t fy = std::clamp<std::int64_t>(n * y + n / 2 - truth.y, 0, truth.height - 1);
      const std::int64_t square = squares[static_cast<std::size_t>(fy * truth.width + fx)];
      clearance_m_.push_back(square < 0 ? INFINITY
                                        : static_cast<float>(fine_m_ * std::sqrt(static_cast<double>(square))));
    }
  }
}

double Clearance::at(GridCell c) const {
  return clearance_m_[static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(c.x)];
}

Way Clearance::judge(Planner& planner, const CostGrid& grid, const Route& route, double radius_m) const {
  Way way;
  GridPath path = planner.find(grid, route.from, route.to);
  way.found = path.found();
  if (!way.found) return way;
  way.length_m = path.length * cell_m_;
  way.least_m = INFINITY;
  for (const GridCell c : path.cells) {
    const double d = at(c);
    way.least_m = std::min(way.least_m, d);
    way.mean_m += d / static_cast<double>(path.cells.size());
    way.in_obstacle += d == 0;
    way.too_near += d < radius_m;
  }
  way.cells = std::move(path.cells);
  return way;
}

}  // namespace evigrid::driver
