// SPDX-License-Identifier: Apache-2.0
// The closed loop of Delafosse et al. 2007: stop, see, match, correct the place, fuse; and how the beacons that come
// out of it lie by the true edges.
#pragma once
#include <string>
#include <vector>

#include "out/layers.hpp"
#include "paper/delafosse2007/beacons.hpp"
#include "paper/paper_world.hpp"

namespace evigrid::driver {

inline constexpr double kGate_m = 0.5;      // figure 9
inline constexpr double kLandmark_m = 0.3;  // what a beacon has to keep
inline constexpr double kSure = 0.8;        // m(yes) of a beacon that counts, seen again at least kSeen times
inline constexpr std::size_t kSeen = 3;

/// What a beacon's cells are told: its whole accumulated mass at every match, as the paper has it, or only what is new.
enum class Evidence { accumulated, increment };

/// What else one may read differently, for finding out what an error comes from.
struct LoopVariant {
  bool true_heading = false;  ///< else the wheels'
  bool box_centre = false;    ///< the centre of gravity is looked for around the newest box; else around the beacon
};

struct LoopRun {
  std::vector<Beacon> beacons;
  std::vector<Pose2> way;  ///< corrected
  std::vector<double> error_m, odometry_error_m;
  std::size_t primitives = 0, parallel = 0, too_wide = 0, matches = 0, false_matches = 0;
  std::vector<bool> in_sight;  ///< of each edge: whether both cameras saw it at some stop
  std::size_t blind = 0;       ///< stops at which no edge is in sight of both cameras
  Layers layers;
};

struct LoopWorld {
  PaperWorld room;
  std::vector<raycast::Point> edges;
  std::vector<double> radii_m;
  CellRect rect{};
  std::vector<scenes::Pose> truth, odometry;
  std::string plan;  ///< the user's; empty: the paper's hall
};

/// The paper's hall, or a loop in the user's building, of which the part around the loop is kept. Throws InputError.
[[nodiscard]] LoopWorld make_loop_world(const PaperOptions& options);
/// Throws InputError when no stop sees anything.
[[nodiscard]] LoopRun map_loop(const LoopWorld& world, Evidence evidence, const LoopVariant& variant = {});

struct Landmarks {
  std::size_t sure = 0, within = 0, found = 0;  ///< beacons that count; of those near an edge; edges with one near
  double mean_m = 0, most_m = 0;                ///< from such a beacon to the nearest edge
};
[[nodiscard]] Landmarks judge(const LoopRun& run, const LoopWorld& world);

}  // namespace evigrid::driver
