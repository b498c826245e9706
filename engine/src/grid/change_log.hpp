// SPDX-License-Identifier: Apache-2.0
// Which parts of which tiles changed, and when: so that a consumer renders what is new and nothing else. A tile is
// looked at in 8 × 8 blocks of 8 × 8 cells; each keeps the version of the map at its last change. Tiles are chained by
// their last change, so that the question costs what changed, however large the map is. Tiles that were dropped are
// remembered for a while.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "evigrid/map.hpp"
#include "grid/tile_store.hpp"

namespace evigrid {

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
/// Box of the blocks that changed after `version`, in cells of the map.
CellRect changed_box(TileIndex, const TileMarks&, std::uint64_t version) noexcept;
CellRect whole_box(TileIndex) noexcept;

/// A tile that is no more, and the version that dropped it.
struct Dropped {
  TileIndex at;
  std::uint64_t version;
};
/// What a version of the map says of itself and of what it lost.
struct Losses {
  std::uint64_t version = 0, cleared = 0;  // now, and when everything was lost last
  std::shared_ptr<const std::vector<Dropped>> dropped;
};
/// The part of Changes that no tile holds.
Changes begin_changes(const Losses&, std::uint64_t since);
/// The tiles to be listed are those that changed after this version: all of them, where what was drawn is void.
inline std::uint64_t listed_since(const Changes& c, std::uint64_t since) noexcept { return c.cleared ? 0 : since; }

class ChangeLog {
 public:
  [[nodiscard]] std::uint64_t version() const noexcept { return losses_.version; }
  /// The version that the next change will have.
  [[nodiscard]] std::uint64_t next() const noexcept { return version() + 1; }

  /// After the owners have marked: brings a marked tile to the front.
  void moved(Tile&);
  /// Before the store erases them. What changed of them is then all of them.
  void drop(std::span<Tile* const>);
  /// The version becomes next(), when something changed.
  void commit() noexcept { ++losses_.version; }
  void clear() noexcept;

  [[nodiscard]] Changes since(std::uint64_t version) const;
  [[nodiscard]] const Tile* newest() const noexcept { return newest_; }
  [[nodiscard]] const Losses& losses() const noexcept { return losses_; }

 private:
  static constexpr std::size_t kMostDropped = 4096;  // beyond it consumers that are older draw everything anew
  void unchain(Tile&) noexcept;
  Tile *newest_ = nullptr, *oldest_ = nullptr;
  Losses losses_;
};

}  // namespace evigrid
