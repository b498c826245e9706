// SPDX-License-Identifier: Apache-2.0
// Interval arithmetic for one triangulation: +, ·, / and the sine and cosine of short intervals. Without outward
// rounding: the bearings' intervals are wider than rounding by eleven orders.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

namespace evigrid::driver {

struct Interval {
  double low = 0, high = 0;
  [[nodiscard]] double middle() const { return (low + high) / 2; }
  [[nodiscard]] double width() const { return high - low; }
  [[nodiscard]] bool has(double x) const { return low <= x && x <= high; }
};

[[nodiscard]] inline Interval operator*(Interval a, Interval b) {
  const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
  return {std::min({p, q, r, s}), std::max({p, q, r, s})};
}
[[nodiscard]] inline Interval operator-(Interval a, Interval b) { return {a.low - b.high, a.high - b.low}; }
/// b must not hold 0.
[[nodiscard]] inline Interval operator/(Interval a, Interval b) { return a * Interval{1 / b.high, 1 / b.low}; }

/// Of an interval shorter than π.
[[nodiscard]] inline Interval cosine(Interval a) {
  const double p = std::cos(a.low), q = std::cos(a.high);
  Interval out{std::min(p, q), std::max(p, q)};
  const double turn = std::numbers::pi;
  const double first = std::ceil(a.low / turn) * turn;  // the extremum in it, if any
  if (first <= a.high) (std::lround(first / turn) % 2 == 0 ? out.high : out.low) = std::cos(first);
  return out;
}
[[nodiscard]] inline Interval sine(Interval a) {
  return cosine({a.low - std::numbers::pi / 2, a.high - std::numbers::pi / 2});
}

}  // namespace evigrid::driver
