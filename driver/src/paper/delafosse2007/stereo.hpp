// SPDX-License-Identifier: Apache-2.0
// Two omnidirectional cameras that see the vertical edges of a world as bearings, their matches with a correlation
// coefficient, some of them false, and what triangulation in interval arithmetic makes of a match: a primitive, a box
// in the platform's frame with masses of existence (Delafosse et al. 2007, sections 2.2, equations 3 and 4).
#pragma once
#include <cstdint>
#include <vector>

#include "evigrid/raycast/scene.hpp"
#include "evigrid/scenes/scene.hpp"
#include "paper/delafosse2007/interval.hpp"

namespace evigrid::driver {

/// On {yes, no}: does it exist? The rest of 1 is ignorance, but for `empty`, m(∅) of the open world.
struct Existence {
  double yes = 0, no = 0, empty = 0;
  [[nodiscard]] double ignorance() const { return 1 - yes - no - empty; }
};

/// Figure 7: from the absolute correlation coefficient of the match.
[[nodiscard]] Existence existence_of_match(double correlation) noexcept;

struct StereoSpec {
  double baseline_m = 0.5;               ///< across the way: left and right of the platform's centre
  double sigma_rad = 0.0026;             ///< of a bearing: 0.15 degrees
  double half_width_rad = 0.007;         ///< of its interval: 0.4 degrees
  double reach_m = 3;                    ///< edges farther away do not stand out
  double widest_m = 0.8;                 ///< boxes with a longer side are of no use, and refused
  double false_share = 0.1;              ///< of the matches that take another edge in the right picture
  double true_low = 0.8, true_high = 1;  ///< correlation of true matches, uniform
  double false_low = 0.5, false_high = 0.85;
};

struct Primitive {
  Interval x, y;  ///< box in the platform's frame
  Existence exists;
  int landmark = -1;  ///< which edge it came from, for judging alone; −1: a false match
};

struct Acquisition {
  std::vector<Primitive> primitives;
  std::vector<int> edges;                  ///< in sight of both cameras
  std::size_t parallel = 0, too_wide = 0;  ///< refused: an unbounded box, a useless one
};

/// Bearing intervals from the left camera at (0, 0) and the right one at (d, 0), from the x axis.
/// x = d tanβ/(tanβ − tanα), y = d tanα tanβ/(tanβ − tanα), multiplied through by cosines, so that bearings of 90
/// degrees have no pole. False when the bearings may be parallel: then the box is unbounded.
[[nodiscard]] bool triangulate(Interval alpha, Interval beta, double d, Interval& x, Interval& y);

/// The vertical edges of a world: corners of outlines and walls; pillars count as their axis.
[[nodiscard]] std::vector<raycast::Point> vertical_edges(const raycast::World& world);

/// What the platform sees at a stop; repeatable from (seed, stop).
[[nodiscard]] Acquisition acquire(const StereoSpec& spec, const raycast::Scene& caster,
                                  const std::vector<raycast::Point>& edges, const std::vector<double>& radii_m,
                                  const scenes::Pose& platform, std::uint64_t seed, std::uint64_t stop);
/// 0 for corners, the radius of pillars, in the order of vertical_edges.
[[nodiscard]] std::vector<double> edge_radii(const raycast::World& world);

}  // namespace evigrid::driver
