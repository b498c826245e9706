// SPDX-License-Identifier: Apache-2.0
// A block of rooms between corridors: its rows, its rooms, its walls with their doors.
#pragma once
#include "building/layout.hpp"

namespace evigrid::scenes {

/// Which of its sides are corridors; the others are the outer wall, which is not the block's.
struct Block {
  Rect rect;
  bool left = false, right = false, low = false, high = false;
};

void build_block(const Block& block, const Measures& measures, std::uint64_t seed, std::uint64_t number, Layout& out);

}  // namespace evigrid::scenes
