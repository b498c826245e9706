// SPDX-License-Identifier: Apache-2.0
// Shades are joined where walls share an end: its cross product with itself is exactly 0, whatever the coordinates. A
// wall hides kHidingSlack_rad beyond its ends, so nothing looks through a joint.
#include "horizon.hpp"

#include <algorithm>
#include <limits>

#include "segment.hpp"

namespace evigrid::raycast {

void Horizon::add(const Surface& s) {
  const Vec2 edge = s.b - s.a;
  if (s.kind != Surface::Kind::segment || is_point(edge)) return;
  const Range r = clip(s.a, edge, wedge_);
  const double farthest = std::max(length(s.a + r.low * edge), length(s.a + r.high * edge));
  if (r.empty() || farthest >= nearest_row_m_) return;
  const bool swap = cross(s.a, s.b) < 0;
  shades_.push_back({swap ? s.b : s.a, swap ? s.a : s.b, farthest});
  // Of several rows the nearest: each one found is asked to be beaten.
  for (double far = row(nearest_row_m_); far < nearest_row_m_; far = row(far)) nearest_row_m_ = far;
  limit_m_ = std::min(limit_m_, nearest_row_m_ * (1 + 1e-9) + 4 * kContact_m);
}

double Horizon::row(double below_m) const {
  Vec2 hidden = wedge_.arc.right;  // everything from the right edge to here
  double farthest = 0;
  for (;;) {
    // Whoever joins and goes farthest to the left; ends inside the wedge span less than π, so that they are in order.
    const Shade* next = nullptr;
    for (const Shade& shade : shades_) {
      if (shade.farthest_m >= below_m || cross(shade.right, hidden) < 0) continue;
      if (cross(wedge_.arc.left, shade.left) >= 0) return std::max(farthest, shade.farthest_m);
      if (cross(next == nullptr ? hidden : next->left, shade.left) > 0) next = &shade;
    }
    if (next == nullptr) return std::numeric_limits<double>::infinity();
    farthest = std::max(farthest, next->farthest_m);
    hidden = next->left;
  }
}

}  // namespace evigrid::raycast
