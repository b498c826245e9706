// SPDX-License-Identifier: Apache-2.0
// Places and the distances between them, m.
#pragma once
#include <cmath>

#include "evigrid/scenes/scene.hpp"

namespace evigrid::driver {

[[nodiscard]] inline raycast::Point place(const scenes::Pose& p) { return {p.x_m, p.y_m}; }
[[nodiscard]] inline double distance(raycast::Point a, raycast::Point b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

}  // namespace evigrid::driver
