// SPDX-License-Identifier: Apache-2.0
// What the map and its views share of a tile: its cells, and which of them changed when. The writer writes into a
// buffer in place as long as no view sees it; else it takes a copy first and leaves the buffer to the views.
#pragma once
#include <array>
#include <cstdint>

#include "grid/tile_memory.hpp"

namespace evigrid {

/// Bit 8·y + x: block (x, y) of a tile.
using BlockMask = std::uint64_t;
inline constexpr int kBlockSide = 8, kBlocksPerSide = 8;

/// Version of the map at the last change of each 8 × 8 block of a tile; 0: never.
struct TileMarks {
  std::array<std::uint64_t, kBlocksPerSide * kBlocksPerSide> version{};
  std::uint64_t last = 0;
  void mark(BlockMask blocks, std::uint64_t now) noexcept;
};

struct TileBuffer {
  TileMemory::Room room;
  TileMarks marks;
  std::uint64_t born = 0, died = 0;  // ages (tile_ages.hpp)
  [[nodiscard]] float* cells() const noexcept { return room.at; }
};

}  // namespace evigrid
