// SPDX-License-Identifier: Apache-2.0
// The loop and the landmarks of a user's building: a way out along the tour and back, and the corners of the plan that
// stand out.
#pragma once
#include <string>
#include <vector>

#include "paper/paper_world.hpp"
#include "paper/plan_ways.hpp"

namespace evigrid::driver {

/// A stretch of 25 m of the scene's tour and the shortest way back to where it began; of all such stretches the one
/// from which the most landmarks are in sight, summed over its stops, or the tour's own first when `from_start`. Ours:
/// the paper's loop is about as long, and the heading, which is the wheels', would be lost on a much longer one.
/// Throws InputError naming the plan when the robot has nowhere to go.
[[nodiscard]] std::vector<raycast::Point> closed_loop(const PaperWorld& building, PlanWays& ways,
                                                      const std::vector<raycast::Point>& landmarks, double reach_m,
                                                      bool from_start, const std::string& plan);

inline constexpr double kArm_m = 0.3, kApart_m = 0.6;

/// The vertical edges that stand out within `reach_m` of the box around `way`: vertices where an outline turns by 45
/// degrees and more between the points kArm_m before and behind them, the sharpest first, each at least kApart_m from
/// all before it: rough walls of scanned plans have thousands of small corners, which no camera would tell apart. Of
/// single walls, as meshes have them, the ends. Circles are left out, and what bounds no space that can be reached.
[[nodiscard]] std::vector<raycast::Point> standing_corners(const raycast::World& world, const PlanWays& ways,
                                                           const std::vector<raycast::Point>& way, double reach_m);

}  // namespace evigrid::driver
