// SPDX-License-Identifier: Apache-2.0
// The plan of a generated building in whole millimetres: integers only, so that no rounding of any machine decides
// where a wall stands. A block of rooms owns its walls: they lie within its rectangle, between it are corridors.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "evigrid/raycast/noise.hpp"

namespace evigrid::scenes {

using Mm = std::int64_t;

struct Rect {
  Mm x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  [[nodiscard]] Mm width() const { return x1 - x0; }
  [[nodiscard]] Mm height() const { return y1 - y0; }
};

inline bool overlap(const Rect& a, const Rect& b) { return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1; }

/// Draws of one thing of the building (a block, a room): they depend on its number only.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint32_t kind, std::uint64_t number) : key_{seed, kind, 0, number} {}

  /// Uniform in [low, high]; low when there is nothing between.
  Mm between(Mm low, Mm high) {
    if (high <= low) return low;
    const std::uint64_t bits = raycast::random_bits(key_, draw_++) >> 32;
    return low + static_cast<Mm>((bits * static_cast<std::uint64_t>(high - low + 1)) >> 32);
  }
  bool chance(int percent) { return between(0, 99) < percent; }
  double unit() { return static_cast<double>(raycast::random_bits(key_, draw_++) >> 32) * 0x1p-32; }

 private:
  raycast::NoiseKey key_;
  std::uint32_t draw_ = 0;
};

struct Measures {
  Mm width, depth, room, corridor, door, wall;
};

enum class Finish : std::uint8_t { plaster, glass };

struct WallPiece {
  Rect rect;
  Finish finish;
};

struct Room {
  Rect inside;              ///< between its walls
  std::vector<Rect> doors;  ///< openings, as deep as the wall
};

struct Layout {
  std::vector<WallPiece> walls;
  std::vector<Room> rooms;
};

/// The measures must fit together (make_building checks them).
[[nodiscard]] Layout lay_out(const Measures& measures, std::uint64_t seed);

}  // namespace evigrid::scenes
