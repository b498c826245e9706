// SPDX-License-Identifier: Apache-2.0
// The slow and exact answer, needed when the nearest surface point in the cone gives no echo: which echoing point is
// nearest among those that nothing hides. Plane visibility in double, by candidates.
#pragma once
#include <vector>

#include "surface.hpp"
#include "wedge.hpp"

namespace evigrid::raycast {

/// `surfaces`: all that reach into the wedge within `max_range_m`, apex at the origin and touching none of them. Those
/// that absorb too much to be heard from where they are hide all the same.
/// Returns +∞ when nothing is visible and echoes within max_range_m.
double nearest_visible_echo(const std::vector<Surface>& surfaces, const Wedge& wedge, double max_range_m);

}  // namespace evigrid::raycast
