// SPDX-License-Identifier: Apache-2.0
// The robot as agents (Li et al. 2014, figure 1): perception (sonars, the filter of false reflections in the map),
// localization (heading.hpp), path planning (path_agent.hpp), behaviour (goto, avoid), actuator (the scene's robot) and
// the client that keeps the map. One pass through all of them a cycle of 100 ms.
#pragma once
#include <cmath>
#include <vector>

#include "out/layers.hpp"
#include "paper/li2014/path_agent.hpp"
#include "paper/paper_world.hpp"

namespace evigrid::driver {

enum class Steering {
  agents,           ///< path planning, goto and avoid
  potential_field,  ///< the paper's contrast: the field alone, of the goal and the echoes
};

struct GermOptions {
  Steering steering = Steering::agents;
  raycast::Point goal{};
  double limit_s = 150;         ///< then the run is over
  double give_up_s = INFINITY;  ///< the agents' run is over, too, when the map has left no way for so long
  std::uint64_t seed = 0;
  int threads = 0;
  bool keep_map = false;  ///< render it at the end
};

struct GermRun {
  bool reached = false;
  double time_s = 0, way_m = 0;
  std::vector<Pose2> poses;           ///< true, one a cycle
  std::vector<raycast::Point> goals;  ///< every turning goal that was driven to
  std::size_t plans = 0;              ///< by A*, the first included
  std::size_t without_way = 0;        ///< cycles in which the map left no way
  std::size_t avoided = 0;            ///< cycles in which the avoid agent had the motors
  std::size_t touched_walls = 0;      ///< cycles in which the body would have touched what stands still
  std::size_t touched_mover = 0;      ///< cycles in which it overlapped what moves
  double pose_error_m = 0;            ///< believed against true, at the end
  std::vector<double> cycle_ms;       ///< computation of each cycle, the simulator's left out
  Layers layers;
};

/// The scene's rule, cells and filter of false reflections.
[[nodiscard]] MapParams germ_params(const scenes::Scene& scene);

/// Deterministic from the seed but for cycle_ms.
[[nodiscard]] GermRun run_germ(const PaperWorld& world, const GermOptions& options);

}  // namespace evigrid::driver
