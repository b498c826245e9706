// SPDX-License-Identifier: Apache-2.0
// What is nearest in a cone, asked of one surface after the other: the nearest point that gives an echo and the nearest
// one that does not. Which surfaces are worth asking is for an index to say; the answer does not depend on their order.
#pragma once
#include <algorithm>
#include <limits>

#include "rays.hpp"
#include "reject.hpp"
#include "segment.hpp"
#include "surface.hpp"
#include "wedge.hpp"

namespace evigrid::raycast {

class NearestEcho {
 public:
  NearestEcho(const Wedge& wedge, double max_range_m) : wedge_(wedge), max_range_m_(max_range_m) {}

  /// `s`: seen from the apex.
  void consider(const Surface& s, SurfaceName) {
    if (surely_outside(s, wedge_, limit_m())) return;
    const auto point =
        s.kind == Surface::Kind::segment ? nearest_of_segment(s.a, s.b, wedge_) : nearest_in_wedge(s, wedge_);
    if (!point) return;
    const double range_m = length(*point);
    double& nearest = range_m <= heard_m(s, max_range_m_) && within_critical(s, *point) ? echo_m : silent_m;
    nearest = std::min(nearest, range_m);
  }
  /// What is farther away than this need not be considered: a silent surface at the distance of the echo must.
  [[nodiscard]] double limit_m() const { return std::min(first_m(), max_range_m_ + kContact_m) + 4 * kContact_m; }
  [[nodiscard]] double first_m() const { return std::min(echo_m, silent_m); }

  double echo_m = std::numeric_limits<double>::infinity(), silent_m = echo_m;

 private:
  const Wedge& wedge_;
  double max_range_m_;
};

}  // namespace evigrid::raycast
