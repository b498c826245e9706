// SPDX-License-Identifier: Apache-2.0
// Ways through the free space of a user's building, as someone who knows the plan would take them: for choosing loops
// and goals, and as the yardstick of what a robot drives that does not know it.
#pragma once
#include <cstddef>
#include <functional>
#include <vector>

#include "evigrid/scenes/scene.hpp"
#include "navigate/astar.hpp"
#include "paper/points.hpp"

namespace evigrid::driver {

/// m along straight lines from point to point.
[[nodiscard]] double length_of(const std::vector<raycast::Point>& way);
/// The way between two lengths along it, both within [0, length_of(way)]; at least one point.
[[nodiscard]] std::vector<raycast::Point> stretch_of(const std::vector<raycast::Point>& way, double from_m,
                                                     double to_m);

/// Where the stretch of `long_m` begins at whose places, one every metre, `worth` sums up to the most; of equal ones
/// the first. m along the way; 0 when it is not longer than that.
[[nodiscard]] double best_stretch(const std::vector<raycast::Point>& way, double long_m,
                                  const std::function<std::size_t(raycast::Point)>& worth);

class PlanWays {
 public:
  /// Of the scene's world for its robot; free is what can be reached from the start of its trajectory. Cells of 5 cm,
  /// in large buildings coarser ones. Throws InputError when the start lies in a wall.
  explicit PlanWays(const scenes::Scene& scene);
  /// The shortest way that keeps the radius from the walls, places near a wall being dearer. Corners only; empty when
  /// there is none.
  [[nodiscard]] std::vector<raycast::Point> find(raycast::Point from, raycast::Point to);
  /// Does free space come within two cells of p? What bounds no free space nobody sees.
  [[nodiscard]] bool beside_free(raycast::Point p) const;

 private:
  [[nodiscard]] GridCell cell(raycast::Point p) const;
  double x_ = 0, y_ = 0, cell_m_ = 0.05;
  std::vector<bool> free_;  // of the cells of grid_, the radius left out
  CostGrid grid_;
  Planner planner_;
};

}  // namespace evigrid::driver
