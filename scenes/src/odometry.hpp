// SPDX-License-Identifier: Apache-2.0
// What the wheels report of one motion, for runs along a given way and for robots that decide as they go.
#pragma once
#include <cstdint>

#include "evigrid/scenes/scene.hpp"

namespace evigrid::scenes {

/// The pose that the robot believes in after `motion` from `believed`. Noise is keyed by (seed, robot 0, wheel, step)
/// and `piece`, the number of the motion within its step.
[[nodiscard]] Pose believed_after(const Pose& believed, const Motion& motion, const OdometrySpec& odometry,
                                  std::uint64_t seed, std::uint64_t step, std::uint32_t piece);

}  // namespace evigrid::scenes
