// SPDX-License-Identifier: Apache-2.0
// The two kinds of curve that a world's surfaces are made of, without their materials: straight segments and circles.
// Metres, map frame. A box has the corners that the ray caster gives it, bit by bit.
#pragma once
#include <vector>

#include "evigrid/raycast/world.hpp"

namespace evigrid::scenes {

struct Segment {
  raycast::Point a, b;
};

struct Ring {
  raycast::Point centre;
  double radius_m = 0;
};

struct Outline {
  std::vector<Segment> segments;
  std::vector<Ring> rings;
};

/// Throws std::invalid_argument naming the object, e.g. "box 2: a number is not finite".
[[nodiscard]] Outline take_apart(const raycast::World& world);

}  // namespace evigrid::scenes
