// SPDX-License-Identifier: Apache-2.0
#include "scan/false_reflection.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace evigrid {
namespace {

constexpr double kTurn = 2 * std::numbers::pi, kWidestGap = std::numbers::pi / 3 + 1e-9;

double from_zero(double angle) {
  const double a = std::remainder(angle, kTurn);
  return a < 0 ? a + kTurn : a;
}

}  // namespace

std::vector<std::size_t> false_reflections(std::vector<RingReading> ring, double tolerance_m) {
  std::vector<std::size_t> out;
  const std::size_t n = ring.size();
  if (n < 3) return out;
  for (RingReading& r : ring) r.bearing_rad = from_zero(r.bearing_rad);
  std::stable_sort(ring.begin(), ring.end(),
                   [](const RingReading& a, const RingReading& b) { return a.bearing_rad < b.bearing_rad; });
  for (std::size_t i = 0; i < n; ++i) {
    const RingReading &third = ring[i], &second = ring[(i + n - 1) % n], &first = ring[(i + n - 2) % n];
    if (from_zero(third.bearing_rad - second.bearing_rad) > kWidestGap ||
        from_zero(second.bearing_rad - first.bearing_rad) > kWidestGap) {
      continue;
    }
    const double step = std::fabs(static_cast<double>(first.range_m) - second.range_m);
    const double leap = std::fabs(static_cast<double>(third.range_m) - second.range_m);
    if (leap >= step + tolerance_m) out.push_back(third.index);  // never so with a NaN among them
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace evigrid
