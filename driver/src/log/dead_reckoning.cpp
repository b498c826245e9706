// SPDX-License-Identifier: Apache-2.0
// The best rotation of two sets of matched points in the plane is the angle of Σ conj(a)·b about their means
// (Kabsch 1976, in two dimensions).
#include "log/dead_reckoning.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace evigrid::driver {

Pose2 driven(const Pose2& from, double left_m, double right_m, double track_m) {
  const double way_m = (left_m + right_m) / 2, turn_rad = (right_m - left_m) / track_m;
  // Chord of the arc: way · sin(turn/2)/(turn/2), along the heading half way.
  const double half = turn_rad / 2;
  const double chord_m = std::abs(half) < 1e-9 ? way_m : way_m * std::sin(half) / half;
  return {from.x_m + chord_m * std::cos(from.yaw_rad + half), from.y_m + chord_m * std::sin(from.yaw_rad + half),
          from.yaw_rad + turn_rad};
}

Pose2 pose_at(std::span<const TimedPose> way, std::int64_t stamp_ns) {
  const auto after = std::upper_bound(way.begin(), way.end(), stamp_ns,
                                      [](std::int64_t t, const TimedPose& p) { return t < p.stamp_ns; });
  if (after == way.begin()) return way.front().pose;
  if (after == way.end()) return way.back().pose;
  const TimedPose& a = *(after - 1);
  const TimedPose& b = *after;
  const double part = static_cast<double>(stamp_ns - a.stamp_ns) / static_cast<double>(b.stamp_ns - a.stamp_ns);
  return {std::lerp(a.pose.x_m, b.pose.x_m, part), std::lerp(a.pose.y_m, b.pose.y_m, part),
          std::lerp(a.pose.yaw_rad, b.pose.yaw_rad, part)};
}

ReferenceFit fit_reference(std::span<const TimedPose> way, std::span<const TimedPosition> reference) {
  using Complex = std::complex<double>;
  std::vector<Complex> ours, theirs;
  Complex our_mean = 0, their_mean = 0;
  for (const TimedPosition& r : reference) {
    if (way.empty() || r.stamp_ns < way.front().stamp_ns || r.stamp_ns > way.back().stamp_ns) continue;
    const Pose2 p = pose_at(way, r.stamp_ns);
    ours.emplace_back(p.x_m, p.y_m);
    theirs.emplace_back(r.x_m, r.y_m);
    our_mean += ours.back();
    their_mean += theirs.back();
  }
  ReferenceFit fit{.points = ours.size()};
  if (fit.points < 2) return fit;
  const auto n = static_cast<double>(fit.points);
  our_mean /= n;
  their_mean /= n;
  Complex sum = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) sum += std::conj(ours[i] - our_mean) * (theirs[i] - their_mean);
  fit.yaw_rad = std::arg(sum);
  const Complex turn = std::polar(1.0, fit.yaw_rad);
  double squares = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const double off_m = std::abs(turn * (ours[i] - our_mean) - (theirs[i] - their_mean));
    squares += off_m * off_m;
    fit.max_m = std::max(fit.max_m, off_m);
  }
  fit.rms_m = std::sqrt(squares / n);
  return fit;
}

}  // namespace evigrid::driver
