// SPDX-License-Identifier: Apache-2.0
// The question a sonar asks, and its answer. A cone is closed: its edges, its apex and both range limits belong to it.
#pragma once
#include <limits>

#include "evigrid/raycast/export.hpp"

namespace evigrid {
namespace EVIGRID_RAYCAST_API raycast {

/// One ping, in the map frame: apex, direction of the axis, full opening.
struct ConeQuery {
  double x_m = 0, y_m = 0, yaw_rad = 0;
  double aperture_rad = 0;  ///< full opening, in [0, 3]; 0 is a single ray
  double min_range_m = 0;   ///< an echo from nearer is reported as too close
  double max_range_m = 0;   ///< an echo from farther is not heard
};

/// One revolution or sweep of a laser: beam i looks to yaw_rad + first_rad + i·step_rad.
struct FanQuery {
  double x_m = 0, y_m = 0, yaw_rad = 0;
  double first_rad = 0, step_rad = 0;
  int beams = 0;
  double max_range_m = 0;
};

enum class EchoStatus {
  ok,        ///< range_m is the distance of the nearest echo
  none,      ///< nothing within max_range_m that is visible and gives an echo
  too_close  ///< the nearest echo is nearer than min_range_m; range_m is its distance
};

struct Echo {
  EchoStatus status = EchoStatus::none;
  double range_m = std::numeric_limits<double>::infinity();  ///< +∞ when there is no echo
};

}  // namespace raycast
}  // namespace evigrid
