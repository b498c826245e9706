// SPDX-License-Identifier: Apache-2.0
// What both casters have in common: refusing bad questions, and wording an answer.
#pragma once
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "evigrid/raycast/cone.hpp"
#include "tolerance.hpp"

namespace evigrid::raycast {

inline void check(const ConeQuery& q) {
  const auto require = [](bool good, const char* problem) {
    if (!good) throw std::invalid_argument(std::string("cone query: ") + problem);
  };
  require(std::isfinite(q.x_m) && std::isfinite(q.y_m) && std::isfinite(q.yaw_rad), "the pose is not finite");
  require(q.aperture_rad >= 0 && q.aperture_rad <= 3, "aperture_rad is outside [0, 3]");
  require(q.min_range_m >= 0 && q.max_range_m >= q.min_range_m && std::isfinite(q.max_range_m),
          "0 <= min_range_m <= max_range_m < infinity does not hold");
}

inline void check_ray(double x_m, double y_m, double angle_rad, double max_range_m) {
  if (!std::isfinite(x_m) || !std::isfinite(y_m) || !std::isfinite(angle_rad) || !(max_range_m >= 0))
    throw std::invalid_argument("ray: not finite, or max_range_m is negative");
}

/// Both range limits are closed, to within kContact_m.
inline Echo echo_at(double range_m, const ConeQuery& q) {
  if (range_m > q.max_range_m + kContact_m) return {};
  if (range_m < q.min_range_m - kContact_m) return {EchoStatus::too_close, range_m};
  return {EchoStatus::ok, std::clamp(range_m, q.min_range_m, q.max_range_m)};
}

}  // namespace evigrid::raycast
