// SPDX-License-Identifier: Apache-2.0
// Poses from wheel ticks for logs that hold no pose, and how well such a way fits reference positions of another frame.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "evigrid/types.hpp"

namespace evigrid::driver {

struct TimedPose {
  std::int64_t stamp_ns = 0;
  Pose2 pose{};
};

/// One step of a differential drive whose wheels went `left_m` and `right_m`: an arc of an exact circle.
Pose2 driven(const Pose2& from, double left_m, double right_m, double track_m);

/// The pose at a time within `way` (sorted, not empty), linear between its poses; its ends hold beyond it.
Pose2 pose_at(std::span<const TimedPose> way, std::int64_t stamp_ns);

struct TimedPosition {
  std::int64_t stamp_ns = 0;
  double x_m = 0, y_m = 0;
};

/// The rotation and shift (no scale) that bring the way nearest to the reference in the least-squares sense, and what
/// remains. Independent of where either frame starts.
struct ReferenceFit {
  std::size_t points = 0;
  double rms_m = 0, max_m = 0;
  double yaw_rad = 0;  ///< from the frame of the way to that of the reference
};
ReferenceFit fit_reference(std::span<const TimedPose> way, std::span<const TimedPosition> reference);

}  // namespace evigrid::driver
