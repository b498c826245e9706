// SPDX-License-Identifier: Apache-2.0
// Beacons: what was seen, in the reference frame, with a belief of its existence; matched with new primitives in the
// extended open world {*, Q1 … Qq} (Delafosse et al. 2007, section 3).
#pragma once
#include <cstddef>
#include <vector>

#include "paper/delafosse2007/tbm_grid.hpp"

namespace evigrid::driver {

struct Beacon {
  raycast::Point centre{};
  Existence exists;
  std::size_t matched = 0;  ///< how often it was seen again
};

/// A primitive in the reference frame.
struct Placed {
  Interval x, y;
  Existence exists;
  [[nodiscard]] raycast::Point centre() const { return {x.middle(), y.middle()}; }
};
/// The smallest box with the axes of the reference frame around the turned one.
[[nodiscard]] Placed placed(const Primitive& primitive, const scenes::Pose& platform);

/// Smets' operator on existences: conjunctive, m(∅) kept.
[[nodiscard]] Existence fused(const Existence& a, const Existence& b);
/// Figure 11: how sure a match of that pignistic probability is.
[[nodiscard]] Existence certainty_of_match(double p) noexcept;

struct Association {
  int beacon = -1;  ///< −1: *, no match
  double p = 0;     ///< pignistic probability of the choice
};
/// One primitive against the beacons that are still free; by the distance of the centres: m(Q) falls from 0.95 at 0 to
/// 0 at `gate_m`, m(not Q) rises from there to 0.95 at twice as far; beacons beyond that are left out, and of more than
/// seven the farther ones. Fused by Dubois and Prade.
[[nodiscard]] Association associate(const Placed& primitive, const std::vector<Beacon>& beacons,
                                    const std::vector<bool>& taken, double gate_m);

}  // namespace evigrid::driver
