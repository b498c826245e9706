// SPDX-License-Identifier: Apache-2.0
#include "paper/plan_ways.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "error.hpp"
#include "evigrid/scenes/simulate.hpp"
#include "evigrid/scenes/truth.hpp"
#include "navigate/distance_transform.hpp"

namespace evigrid::driver {
namespace {

using raycast::Point;

constexpr double kMostCells = 1 << 25;
constexpr double kRoom_m = 0.3;  // as far beyond the radius a step is dearer, at the radius itself
constexpr float kNarrow = 3;     // by as much
constexpr double kLook_m = 1;    // between two places of a way that are asked
constexpr int kBeside = 2;       // cells: a wall on the border of two cells fills both
constexpr int kNearby = 3;       // cells: the ends of a way may lie beside what is free

}  // namespace

double length_of(const std::vector<Point>& way) {
  double sum = 0;
  for (std::size_t i = 1; i < way.size(); ++i) sum += distance(way[i - 1], way[i]);
  return sum;
}

std::vector<Point> stretch_of(const std::vector<Point>& way, double from_m, double to_m) {
  std::vector<Point> out;
  const auto add = [&](Point p) {
    if (out.empty() || distance(out.back(), p) > 1e-9) out.push_back(p);
  };
  double at = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double d = distance(way[i - 1], way[i]);
    const auto between = [&](double s) {
      const double t = (s - at) / d;
      return Point{way[i - 1].x_m + t * (way[i].x_m - way[i - 1].x_m),
                   way[i - 1].y_m + t * (way[i].y_m - way[i - 1].y_m)};
    };
    if (d > 0 && from_m <= at + d && to_m >= at) {
      add(between(std::max(from_m, at)));
      add(between(std::min(to_m, at + d)));
    }
    at += d;
  }
  if (out.empty()) out.push_back(way.front());
  return out;
}

double best_stretch(const std::vector<Point>& way, double long_m, const std::function<std::size_t(Point)>& worth) {
  const double all_m = length_of(way);
  if (all_m <= long_m) return 0;
  const auto count = static_cast<std::size_t>(long_m / kLook_m);
  std::vector<std::size_t> at;
  std::size_t sum = 0, most = 0;
  double best_m = 0;
  for (double s = 0; s <= all_m; s += kLook_m) {
    at.push_back(worth(stretch_of(way, s, s).front()));
    sum += at.back();
    if (at.size() > count) sum -= at[at.size() - 1 - count];
    if (at.size() >= count && sum > most) most = sum, best_m = kLook_m * static_cast<double>(at.size() - count);
  }
  return best_m;
}

PlanWays::PlanWays(const scenes::Scene& scene) {
  const scenes::Extent box = scenes::extent(scene.world);
  while ((box.high.x_m - box.low.x_m) * (box.high.y_m - box.low.y_m) > kMostCells * cell_m_ * cell_m_) cell_m_ *= 2;
  const scenes::Pose start = scenes::drive(scene.trajectory).front();
  scenes::TruthGrid truth;
  try {
    truth = scenes::rasterise(scene.world, cell_m_, {start.x_m, start.y_m});
  } catch (const std::invalid_argument& in_wall) {
    throw InputError(std::string("the start: ") + in_wall.what());
  }
  x_ = static_cast<double>(truth.x), y_ = static_cast<double>(truth.y);
  std::vector<std::uint8_t> walls(truth.cells.size());
  std::transform(truth.cells.begin(), truth.cells.end(), walls.begin(),
                 [](scenes::TruthCell c) { return c != scenes::TruthCell::free; });
  for (const std::uint8_t wall : walls) free_.push_back(wall == 0);
  const auto squares = squared_distances(walls, static_cast<int>(truth.width), static_cast<int>(truth.height));
  grid_ = CostGrid(static_cast<int>(truth.width), static_cast<int>(truth.height));
  for (std::size_t i = 0; i < squares.size(); ++i) {
    if (squares[i] < 0) continue;
    const double room = cell_m_ * std::sqrt(static_cast<double>(squares[i])) - scene.radius_m;
    grid_.cost[i] = room < 0 ? kBlocked : 1 + kNarrow * static_cast<float>(std::max(0.0, 1 - room / kRoom_m));
  }
}

GridCell PlanWays::cell(Point p) const {
  const GridCell at{static_cast<int>(std::floor(p.x_m / cell_m_) - x_),
                    static_cast<int>(std::floor(p.y_m / cell_m_) - y_)};
  GridCell best = at;
  int least = 2 * kNearby * kNearby + 1;
  for (int dy = -kNearby; dy <= kNearby; ++dy) {
    for (int dx = -kNearby; dx <= kNearby; ++dx) {
      const GridCell c{at.x + dx, at.y + dy};
      if (dx * dx + dy * dy < least && grid_.free(c)) least = dx * dx + dy * dy, best = c;
    }
  }
  return best;
}

bool PlanWays::beside_free(Point p) const {
  const int x = static_cast<int>(std::floor(p.x_m / cell_m_) - x_),
            y = static_cast<int>(std::floor(p.y_m / cell_m_) - y_);
  for (int dy = -kBeside; dy <= kBeside; ++dy)
    for (int dx = -kBeside; dx <= kBeside; ++dx)
      if (const GridCell c{x + dx, y + dy}; grid_.inside(c) && free_[grid_.index(c)]) return true;
  return false;
}

std::vector<Point> PlanWays::find(Point from, Point to) {
  const GridCell a = cell(from), b = cell(to);
  if (!grid_.free(a) || !grid_.free(b)) return {};
  const GridPath path = planner_.find(grid_, a, b);
  if (!path.found()) return {};
  std::vector<Point> out{from};
  for (const GridCell c : corners(path.cells)) out.push_back({(x_ + c.x + 0.5) * cell_m_, (y_ + c.y + 0.5) * cell_m_});
  out.push_back(to);
  return out;
}

}  // namespace evigrid::driver
