// SPDX-License-Identifier: Apache-2.0
// The behaviour of Hughes & Murphy 1992, section 4: sense, update the map by Dempster's rule, take the centroid of what
// is surely empty and little disputed, move towards it, at most 0.5 m at a time; done within 13 cm of it. And what the
// paper sets against it, the vector sum of averaged readings.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "evigrid/map.hpp"
#include "paper/paper_world.hpp"
#include "paper/robot_map.hpp"

namespace evigrid::driver {

inline constexpr int kMostMoves = 10;                        // where the paper ends a run that does not settle
inline constexpr double kStation_m = 0.457, kApart_m = 1.8;  // 1.5 feet, 6 feet

struct StationRun {
  std::vector<scenes::Pose> poses;     ///< where the robot sensed
  std::vector<raycast::Point> aims;    ///< what it then took for the station
  std::size_t least_cells = SIZE_MAX;  ///< that passed both tests, over the run
  bool settled = false;
  [[nodiscard]] int moves() const { return static_cast<int>(poses.size()) - 1; }
  [[nodiscard]] raycast::Point end() const { return {poses.back().x_m, poses.back().y_m}; }
};

struct StationOptions {
  NoEcho no_echo = NoEcho::empty_cone;
  int most_moves = kMostMoves;
  int threads = 0;
};
/// @param after called with the map after each sensing.
[[nodiscard]] StationRun move_to_station(const PaperWorld& world, const scenes::Pose& start, std::uint64_t seed,
                                         const StationOptions& options,
                                         const std::function<void(const Map&, const StationRun&)>& after = {});

/// Section 5.2: the vector sum of readings, each averaged over three consecutive ones; no echo counts as the full
/// range.
[[nodiscard]] StationRun average_to_station(const PaperWorld& world, const scenes::Pose& start, std::uint64_t seed);

/// Starts within a circle of diameter kApart_m around `around`, where the robot has room; any heading. Throws
/// InputError when there is none.
[[nodiscard]] std::vector<scenes::Pose> starts_around(const PaperWorld& world, raycast::Point around, std::size_t count,
                                                      std::uint64_t seed);

struct Spread {
  raycast::Point centre{};
  double largest_m = 0;
  std::size_t within = 0, settled = 0;  ///< runs that end within kStation_m; that settled
  int most_moves = 0;
};
[[nodiscard]] Spread spread(const std::vector<StationRun>& runs, raycast::Point centre);
/// Centre of the smallest circle around the ends, by Bădoiu & Clarkson's iteration (2003).
[[nodiscard]] raycast::Point enclosing_centre(const std::vector<StationRun>& runs);

}  // namespace evigrid::driver
