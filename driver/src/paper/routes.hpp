// SPDX-License-Identifier: Apache-2.0
// Planning on a map and judging the way by the true room: what a step costs, how far from the true surfaces the way
// keeps, where it would collide.
#pragma once
#include <string>
#include <vector>

#include "evigrid/raycast/world.hpp"
#include "navigate/astar.hpp"
#include "out/layers.hpp"

namespace evigrid::driver {

/// One step cost for every map: length × (1 + weight · m), m = max(1 − m(empty), m(occupied)) of the cell stepped into;
/// no step into a cell whose m is above `blocked_above`.
struct StepCost {
  double weight = 10, blocked_above = 0.8;
};
/// m of each cell, which is Pl(occupied) (and P of a Bayes map): Asharif et al. 2001, equation (18).
[[nodiscard]] std::vector<float> occupancy(const Layers& layers);
[[nodiscard]] CostGrid cost_grid(const Layers& layers, const std::vector<float>& occupancy, const StepCost& cost);

struct Route {
  std::string name;
  GridCell from, to;  ///< (column, row) within the rectangle of the map
};

struct Way {
  bool found = false;
  double length_m = 0;
  double least_m = 0, mean_m = 0;  ///< clearance of the cells' centres from the true surfaces
  std::size_t in_obstacle = 0;     ///< cells of the way whose centre lies in an obstacle or wall
  std::size_t too_near = 0;        ///< cells where a robot of that radius would touch something
  std::vector<GridCell> cells;
};

/// Distance of every cell's centre from the nearest true surface, by the exact distance transform of the world at a
/// fraction of the cell; 0 in obstacles.
class Clearance {
 public:
  /// @param inside a point of the free space. Throws std::invalid_argument when it is in a wall.
  Clearance(const raycast::World& world, const CellRect& rect, double cell_m, raycast::Point inside);
  [[nodiscard]] double at(GridCell cell) const;
  [[nodiscard]] double raster_m() const { return fine_m_; }  ///< of the transform
  /// Plans and judges.
  [[nodiscard]] Way judge(Planner& planner, const CostGrid& grid, const Route& route, double radius_m) const;

 private:
  int width_ = 0;
  double cell_m_, fine_m_ = 0;
  std::vector<float> clearance_m_;  // of the cells of rect
};

}  // namespace evigrid::driver
