// SPDX-License-Identifier: Apache-2.0
// Crack following: walk along pixel edges with wall on the left and turn by the two pixels ahead. Where those are a
// checkerboard, turn right: the way hugs the free pixel, so walls are joined across the corner (8-connected) and free
// space is not (4-connected). Every edge is walked once; each ring has an edge that goes east along the foot of a wall
// pixel, and that is where rings are found and marked.
#include "pixel_outline.hpp"

#include <array>
#include <stdexcept>

namespace evigrid::scenes {
namespace {

constexpr std::uint8_t kWall = 1, kSeen = 2;  ///< kSeen: the foot of this wall pixel has been walked

/// One byte a pixel with a frame of not-wall around, so that the walk never asks where the image ends.
struct Pixels {
  std::int64_t stride;
  std::vector<std::uint8_t> bytes;

  Pixels(const FloorPlan& plan, bool unknown_is_wall)
      : stride(plan.width + 2), bytes(static_cast<std::size_t>(stride * (plan.height + 2))) {
    for (std::int64_t y = 0; y < plan.height; ++y) {
      const PlanCell* in = plan.cells.data() + y * plan.width;
      std::uint8_t* out = &at(0, y);
      for (std::int64_t x = 0; x < plan.width; ++x)
        out[x] = in[x] == PlanCell::occupied || (unknown_is_wall && in[x] == PlanCell::unknown);
    }
  }
  std::uint8_t& at(std::int64_t x, std::int64_t y) { return bytes[static_cast<std::size_t>((y + 1) * stride + x + 1)]; }
};

enum Direction { east, north, west, south };

/// The pixel to the left ahead of corner (x, y) is (x + left.dx, y + left.dy); the right one likewise.
struct Ahead {
  std::int64_t step_x, step_y, left_dx, left_dy, right_dx, right_dy;
};
constexpr std::array<Ahead, 4> kAhead{{
    {1, 0, 0, 0, 0, -1},     // east
    {0, 1, -1, 0, 0, 0},     // north
    {-1, 0, -1, -1, -1, 0},  // west
    {0, -1, 0, -1, -1, -1},  // south
}};

/// From the foot of wall pixel (x0, y0), whose left end must be a corner of the outline.
void walk(Pixels& pixels, std::int64_t x0, std::int64_t y0, std::size_t most_corners, PixelRing& ring) {
  std::int64_t x = x0, y = y0;
  Direction way = east;
  ring.clear();
  do {
    // Along a straight piece.
    bool left = true, right = false;
    const Ahead& a = kAhead[way];
    do {
      if (way == east) pixels.at(x, y) |= kSeen;
      x += a.step_x;
      y += a.step_y;
      left = pixels.at(x + a.left_dx, y + a.left_dy) & kWall;
      right = pixels.at(x + a.right_dx, y + a.right_dy) & kWall;
    } while (left && !right);
    if (ring.size() == most_corners) throw std::length_error("the plan has too many corners");
    ring.push_back({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), right && !left});
    way = static_cast<Direction>((way + (right ? 3 : 1)) % 4);
  } while (x != x0 || y != y0 || way != east);
}

}  // namespace

void follow_outlines(const FloorPlan& plan, bool unknown_is_wall, std::size_t most_corners,
                     const std::function<void(PixelRing&)>& use) {
  Pixels pixels(plan, unknown_is_wall);
  PixelRing ring;
  std::size_t corners = 0;
  for (std::int64_t y = 0; y < plan.height; ++y) {
    const std::uint8_t *row = &pixels.at(0, y), *below = &pixels.at(0, y - 1);
    for (std::int64_t x = 0; x < plan.width; ++x) {
      if (row[x] != kWall || (below[x] & kWall)) continue;
      walk(pixels, x, y, most_corners - corners, ring);
      corners += ring.size();
      use(ring);
    }
  }
}

}  // namespace evigrid::scenes
