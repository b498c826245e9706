// SPDX-License-Identifier: Apache-2.0
// Which parts of which tiles changed, and when: so that a consumer renders what is new and nothing else. A tile is
// looked at in 8 × 8 blocks of 8 × 8 cells; each keeps the version of the map at its last change. Tiles are chained by
// their last change, so that the question costs what changed, however large the map is.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "evigrid/map.hpp"
#include "grid/tile_store.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid {

/// Bit 8·y + x: block (x, y) of a tile.
using BlockMask = std::uint64_t;
inline constexpr int kBlockSide = 8, kBlocksPerSide = 8;

/// The blocks of a list of micro-tiles; cones number them in bytes, fans in floats.
template <class Number>
BlockMask blocks_of(const Number* micros, int count) noexcept {
  BlockMask mask = 0;
  for (int i = 0; i < count; ++i) {
    const auto micro = static_cast<unsigned>(micros[i]);
    mask |= BlockMask{1} << ((micro >> 5) * kBlocksPerSide + (micro & 15) / 2);
  }
  return mask;
}

/// Of one tile. Its owner may mark it while others mark theirs.
struct TileChange {
  TileIndex at;
  std::array<std::uint64_t, kBlocksPerSide * kBlocksPerSide> version{};  ///< 0: never
  std::uint64_t last = 0;
  TileChange *newer = nullptr, *older = nullptr;  ///< chain by `last`

  void mark(BlockMask blocks, std::uint64_t now) noexcept;
};

class ChangeLog {
 public:
  [[nodiscard]] std::uint64_t version() const noexcept { return version_; }
  /// The version that the next change will have.
  [[nodiscard]] std::uint64_t next() const noexcept { return version_ + 1; }

  /// A record for a tile that has none. Changes nothing that can be seen.
  void enroll(Tile& tile);
  /// After the owners have marked: brings a marked record to the front.
  void moved(TileChange& record) noexcept;
  /// The version becomes next(), when something changed.
  void commit() noexcept { ++version_; }
  void clear() noexcept;

  [[nodiscard]] Changes since(std::uint64_t version) const;

 private:
  std::deque<TileChange> records_;
  TileChange *newest_ = nullptr, *oldest_ = nullptr;
  std::uint64_t version_ = 0, cleared_ = 0;
};

}  // namespace evigrid
