// SPDX-License-Identifier: Apache-2.0
// The path planning agent (Li et al. 2014): A* on the map as it is, unknown cells held for free, obstacles grown by the
// robot's radius; points on one line deleted, so that turning goals are left; planned again only when an echo falls
// into the safety guard district along the way that is left.
#pragma once
#include <optional>
#include <vector>

#include "navigate/astar.hpp"
#include "paper/li2014/field.hpp"

namespace evigrid::driver {

struct PathLimits {
  double radius_m = 0.28;
  double guard_m = 0.02;   ///< half the guard district's width, beyond the radius
  double margin_m = 0.05;  ///< a new way keeps this much beyond the radius where it can
};

class PathAgent {
 public:
  PathAgent(const FieldRect& field, const PathLimits& limits) : field_(field), limits_(limits) {}

  /// Whether there is no way yet, or one of the echoes lies in the guard district.
  [[nodiscard]] bool needs_plan(const std::vector<raycast::Point>& echoes, raycast::Point at) const;
  /// False when the map leaves no way; then there are no turning goals.
  bool plan(const Map& map, raycast::Point at, raycast::Point goal);
  /// The next turning goal, those that were reached being dropped; nullopt without a way.
  [[nodiscard]] std::optional<raycast::Point> next_goal(raycast::Point at, double reached_m);
  [[nodiscard]] const std::vector<raycast::Point>& turning_goals() const { return goals_; }
  void forget() { goals_.clear(); }

 private:
  FieldRect field_;
  PathLimits limits_;
  Planner planner_;
  std::vector<raycast::Point> goals_;  // still ahead
};

/// From p to the straight line from a to b.
[[nodiscard]] double distance_to_line(raycast::Point p, raycast::Point a, raycast::Point b);

}  // namespace evigrid::driver
