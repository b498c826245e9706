// SPDX-License-Identifier: Apache-2.0
// The user's building without anybody in it, mapped on a tour by DSmT and by Dempster's rule from the same readings.
#pragma once
#include <string>
#include <vector>

#include "out/layers.hpp"
#include "paper/paper_world.hpp"
#include "score/score.hpp"

namespace evigrid::driver {

struct TourMap {
  Rule rule;
  Layers layers;
  Score score;
  double mean_cycle_ms = 0, most_cycle_ms = 0;  ///< fusion of one scan
};

struct TourRun {
  std::vector<Pose2> way;
  std::size_t echoes = 0;     ///< of all readings
  std::vector<TourMap> maps;  ///< DSmT, Dempster
};

/// @param most_scans the tour is cut off there. Throws InputError when the building cannot be scored, or no sonar hears
/// anything on the whole way: `plan`, which the message names, is too open.
[[nodiscard]] TourRun map_tour(const PaperWorld& building, const std::string& plan, std::size_t most_scans,
                               int threads);

}  // namespace evigrid::driver
