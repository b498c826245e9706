// SPDX-License-Identifier: Apache-2.0
// Costs of tiles whose cells are not at hand, made where they are: kTileSide rows of kTileSide bytes a tile.
#pragma once
#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>

#include "grid/tile_index.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid {

class TileCosts {
 public:
  static constexpr std::size_t kBytes = std::size_t{kernels::kTileSide} * kernels::kTileSide;
  /// nullptr: the tile's cells are at hand.
  [[nodiscard]] const std::uint8_t* of(TileIndex at) const noexcept {
    const auto tile = tiles_.find(at);
    return tile == tiles_.end() ? nullptr : tile->second.bytes.get();
  }
  /// Whether they are those of that version of the tile.
  [[nodiscard]] bool holds(TileIndex at, std::uint64_t version) const noexcept {
    const auto tile = tiles_.find(at);
    return tile != tiles_.end() && tile->second.version == version;
  }
  void put(TileIndex at, std::uint64_t version, const std::uint8_t* bytes) {
    Costs& c = tiles_[at];
    if (!c.bytes) c.bytes = std::make_unique_for_overwrite<std::uint8_t[]>(kBytes);
    std::copy_n(bytes, kBytes, c.bytes.get());
    c.version = version;
  }

 private:
  struct Costs {
    std::uint64_t version = 0;
    std::unique_ptr<std::uint8_t[]> bytes;
  };
  std::map<TileIndex, Costs> tiles_;
};

}  // namespace evigrid
