// SPDX-License-Identifier: Apache-2.0
// The room of Asharif et al. 2001 (or a plan of the user's), the robot's readings in it, either rule's map of them and
// the eight ways planned on it.
#pragma once
#include <array>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "log/log.hpp"
#include "paper/paper_world.hpp"
#include "paper/routes.hpp"
#include "picture/canvas.hpp"
#include "score/score.hpp"

namespace evigrid::driver::asharif2001 {

inline constexpr double kRevolve_rad_s = std::numbers::pi / 4;  ///< "it revolves while navigating" (ours: how fast)
inline constexpr double kLaserAperture_rad = 2 * std::numbers::pi / 180, kLaserDelta_m = 0.1, kLaserRhoV_m = 4;

/// One rule's map of the readings and the eight ways on it.
struct Planned {
  std::string name;
  Layers layers;
  std::vector<float> m{};
  Score score{};
  double off_ideal = 0;  ///< mean |m − truth| over the cells that are free or surface
  std::vector<Way> ways{};
};

struct Room {
  PaperWorld world;
  scenes::TruthGrid truth;
  CellRect rect;  ///< of the world, without the margin of the truth
  Clearance clearance;
  std::vector<Route> routes;
};

/// Throws InputError.
[[nodiscard]] Room make_room(const PaperOptions& options);

/// The readings along the scene's way, the robot turning all the while, so that its few sensors see everything.
[[nodiscard]] Log sensed(const PaperWorld& world, std::uint64_t seed);
/// The lasers as the paper has them: Oriolo's model, narrow and sharp, believed farther than a sonar.
[[nodiscard]] Log with_oriolo_lasers(Log log);

/// The map by one rule, and its ways under one cost.
[[nodiscard]] Planned fused(const Log& log, Rule rule, const Room& room, int threads);
void plan_ways(Planned& map, const Room& room, const StepCost& cost);

/// Of the routes that both maps have a way for.
struct Compared {
  std::size_t routes = 0, farther = 0;  ///< farther: Dempster's least clearance is at least Bayes'
  std::array<double, 2> least_m{}, mean_m{}, length_m{};
  std::array<std::size_t, 2> found{}, in_obstacle{}, too_near{};  ///< routes; routes with such cells
};
[[nodiscard]] Compared compared(const Planned& dempster, const Planned& bayes);

/// m as the paper draws it (black = 1); with the ways: true surfaces in red and the ways on top.
[[nodiscard]] Canvas draw_map_of(const Planned& map, const Room& room, bool ways);

}  // namespace evigrid::driver::asharif2001
