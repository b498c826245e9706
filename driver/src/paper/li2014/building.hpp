// SPDX-License-Identifier: Apache-2.0
// Where the experiments of Li et al. 2014 take place in a user's building: a patrol beside which a person and two small
// things fit, and goals for the planner. Chosen from the plan alone; the same plan gives the same places.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "paper/paper_world.hpp"
#include "paper/plan_ways.hpp"

namespace evigrid::driver {

/// What spans the building has cells of this size, what lies within reach of one place smaller ones. (The paper's 1 cm
/// would be 37 million cells in a building of 60 m.)
inline constexpr double kBuildingCell_m = 0.05, kPlaceCell_m = 0.02;

/// The paper's scene of that name in the user's plan: its robot, rule and seed, a tour through all that it can reach at
/// its speed. The paper's things and movers are left behind. Throws InputError.
[[nodiscard]] scenes::Scene building_scene(const PaperOptions& options, const char* name, double cell_m);

struct Patrol {
  std::vector<raycast::Point> stretch;  ///< of the tour
  std::array<raycast::Point, 2> walk;   ///< the person goes to and fro between them
  std::vector<raycast::Box> things;     ///< A and B, as large as the paper's; fewer where there is no room
};
/// The first stretch of 4 m of the tour beside which the person and both things stand clear of the walls, of the robot
/// and of one another, and from whose middle the sonars hear walls on most sides (a sonar that hears nothing says
/// nothing: it would not clear the places that the person leaves). Else the first with the most of that. None: nowhere
/// is there room for the person.
[[nodiscard]] std::optional<Patrol> find_patrol(const PaperWorld& building);
/// The part of the building around the stretch, with person and things; the robot drives it to and fro twice, and
/// ends beside the person.
[[nodiscard]] scenes::Scene patrol_scene(const scenes::Scene& building, const Patrol& patrol);
/// The part of the building around `most_m` of the tour: the first, or those in which the most walls are near.
[[nodiscard]] scenes::Scene stretch_scene(const PaperWorld& building, double most_m, bool from_start);

struct Errand {
  raycast::Point goal{};
  std::vector<raycast::Point> shortest;  ///< from the start, as one who knows the plan would go
};
/// For each length the place of the tour farthest from the start by way, but no farther than that; a place once.
[[nodiscard]] std::vector<Errand> find_errands(const scenes::Scene& building, PlanWays& ways,
                                               const std::vector<double>& within_m);
/// Another robot that goes to and fro across the errand's shortest way, near its middle, as in the paper's figures 13
/// to 15; nothing where there is no room for it.
[[nodiscard]] std::optional<scenes::MoverSpec> crossing_robot(const PaperWorld& building, const Errand& errand);

}  // namespace evigrid::driver
