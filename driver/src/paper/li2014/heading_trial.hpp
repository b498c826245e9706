// SPDX-License-Identifier: Apache-2.0
// One drive whose wheels slip or drift, replayed with and without the localization agent: the same readings, the same
// wheels, maps and poses of their own.
#pragma once
#include <cstdint>
#include <vector>

#include "evigrid/scenes/simulate.hpp"
#include "out/layers.hpp"
#include "paper/li2014/heading.hpp"
#include "paper/paper_world.hpp"

namespace evigrid::driver {

/// "The slipping between driver wheels and the ground brings the localization errors; the main error is the angle
/// error, limited in the range of 5 degrees": after every stretch the heading that the wheels tell jumps to the left,
/// by a uniform number up to `most_rad`.
struct Slips {
  double every_m = 1, most_rad = 0.0872664626;
};

struct Replay {
  std::vector<double> error_m, error_rad;  ///< believed against true, one a scan
  std::vector<Pose2> believed;
  double most_cycle_ms = 0;  ///< correction and fusion of one scan
  Layers layers;
};

/// Everything of it by the seed of the scene's trajectory. @param least_gain of the localization agent; below 0: none.
class HeadingTrial {
 public:
  /// @param drifts the scene's wheels drift as its odometry says; else only its noise is left, and they slip.
  HeadingTrial(const PaperWorld& world, std::uint64_t seed, bool drifts, std::size_t most_scans, int threads);
  [[nodiscard]] Replay replay(double least_gain, Match match = Match::empty_and_occupied) const;

 private:
  scenes::Scene scene_;
  Slips slips_;
  std::vector<scenes::Step> steps_;
  int threads_;
};

}  // namespace evigrid::driver
