// SPDX-License-Identifier: Apache-2.0
// What "closed" and "touching" mean in floating point. These numbers are part of the definition of an answer, so the
// caster and the reference share them, and nothing else. Sizes: a sensor range is metres, rounding is 1e-15 m.
#pragma once

namespace evigrid::raycast {

/// The closed cone reaches this far beyond its edges, and the closed echo part of a surface beyond its critical
/// incidence, so that a surface lying exactly on the edge belongs to it whatever the rounding.
inline constexpr double kEdgeSlack_rad = 1e-12;

/// A surface hides this much beyond its own ends. Larger than kEdgeSlack_rad: otherwise the slack of the cone would
/// look past a surface that ends exactly at the edge, and through the joint of two walls.
inline constexpr double kHidingSlack_rad = 4e-12;

/// A sensor this near to a surface stands on it.
inline constexpr double kContact_m = 1e-9;

/// Of two hits on one ray, the nearer one hides the other only when it is nearer by this, relative to 1 m + range:
/// surfaces lying on one another are both seen.
inline constexpr double kTie = 1e-12;

/// A ray that meets a straight surface at a smaller sine than this runs along it: it meets the nearer end.
inline constexpr double kEdgeOn = 1e-15;

}  // namespace evigrid::raycast
