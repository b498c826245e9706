// SPDX-License-Identifier: Apache-2.0
// Which surfaces are near a straight leg? Bins of equal squares hold the segments and circles that pass through them;
// the distances themselves are exact (double). Metres, map frame.
#pragma once
#include <cstdint>
#include <vector>

#include "truth/outline.hpp"

namespace evigrid::scenes {

/// Distance from the segment a–b (a == b: a point) to a curve; 0 when they meet.
[[nodiscard]] double squared_distance(raycast::Point a, raycast::Point b, const Segment& s);
[[nodiscard]] double squared_distance(raycast::Point a, raycast::Point b, const Ring& r);

class Nearby {
 public:
  /// Refers to the outline, which must live longer.
  Nearby(const Outline& outline, double bin_m);

  /// Does the leg a–b stay at least clearance_m away from everything?
  [[nodiscard]] bool keeps(raycast::Point a, raycast::Point b, double clearance_m) const;

 private:
  /// Calls visit(bin) for the bins within reach_m of a–b (and a few more) until it answers true; says whether it did.
  template <class Visit>
  bool any_bin(raycast::Point a, raycast::Point b, double reach_m, Visit visit) const;

  /// Calls visit(bin) once for every bin that the circle passes through (and a few more).
  template <class Visit>
  void each_bin_of(const Ring& r, double slack_m, Visit visit) const;

  const Outline* outline_;
  double bin_m_, x_m_ = 0, y_m_ = 0;  // lower left corner of the bins
  std::int64_t width_ = 0, height_ = 0;
  std::vector<std::uint32_t> begin_;  // of each bin in items_
  std::vector<std::uint32_t> items_;  // segment number, or segments.size() + ring number
};

}  // namespace evigrid::scenes
