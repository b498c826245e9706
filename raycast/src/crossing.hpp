// SPDX-License-Identifier: Apache-2.0
// Where two surfaces cross. Directions in which the order of two surfaces along a ray changes without either ending.
#pragma once
#include "surface.hpp"

namespace evigrid::raycast {

struct Crossings {
  Vec2 point[2];
  int count = 0;
};

/// Parallel or identical surfaces have none: their order never changes. Touching ends count.
Crossings crossings_of(const Surface& s, const Surface& t);

}  // namespace evigrid::raycast
