// SPDX-License-Identifier: Apache-2.0
// Outlines of wall pixels as rings of corners on the lattice of pixel corners, (0, 0) the lower left of the plan.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "evigrid/scenes/plan.hpp"

namespace evigrid::scenes {

struct Corner {
  std::int32_t x = 0, y = 0;
  bool joint = false;  ///< two walls touch here and only here: must stay, or light slips between them
};

using PixelRing = std::vector<Corner>;

/// Calls `use` with one ring after the other; wall lies to the left of the way. A ring is closed, has at least four
/// corners and no corner on a straight piece; `use` may change it. Scratch memory: a byte a pixel and the longest ring.
/// Throws std::length_error beyond `most_corners` corners in all.
void follow_outlines(const FloorPlan& plan, bool unknown_is_wall, std::size_t most_corners,
                     const std::function<void(PixelRing&)>& use);

/// Fewer corners, each edge within `tolerance_px` of the corners it replaces (Douglas–Peucker 1973, on closed rings).
class Simplifier {
 public:
  explicit Simplifier(double tolerance_px) : tolerance_(tolerance_px) {}
  void operator()(PixelRing& ring);

 private:
  void keep_anchors(const PixelRing& ring);
  void split(const PixelRing& ring, std::size_t from, std::size_t to);

  double tolerance_;
  std::vector<bool> keep_;
  std::vector<std::pair<std::size_t, std::size_t>> open_;
};

}  // namespace evigrid::scenes
