// SPDX-License-Identifier: Apache-2.0
// The consumer of a fleet's map: a costmap (one byte a cell, as costmap_2d has it) in tiles of its own, brought up to
// date by what changed and nothing else. Space that no robot has seen takes no memory, so the extent may be any.
#pragma once
#include <cstdint>
#include <memory>
#include <unordered_map>

#include "cycle/cycle_loop.hpp"
#include "evigrid/executor.hpp"
#include "evigrid/map.hpp"

namespace evigrid::driver {

class CostTiles {
 public:
  /// Covers cells [−border, side + border) along x and y; what the map has beyond is not drawn.
  CostTiles(std::int64_t side_cells, std::int64_t border_cells);

  /// Draws what changed since the last call, tiles in parallel.
  Rendered update(const Map& map, Executor& executor);

  [[nodiscard]] std::uint8_t at(std::int64_t x, std::int64_t y) const;  ///< 255 where nothing was drawn
  /// Calls tile(its lower left cell, its rows of kSide bytes) for each that exists, in no order.
  template <class Tile>
  void for_each(Tile tile) const {
    for (const auto& [i, bytes] : tiles_)
      tile(CellIndex{(static_cast<std::int64_t>(i) % side_ + first_) * kSide,
                     (static_cast<std::int64_t>(i) / side_ + first_) * kSide},
           bytes.get());
  }
  [[nodiscard]] std::size_t memory_bytes() const;
  static constexpr std::int64_t kSide = 64;

 private:
  [[nodiscard]] std::size_t index(std::int64_t x, std::int64_t y) const;  ///< of the tile of a cell, or kOutside
  static constexpr std::size_t kOutside = static_cast<std::size_t>(-1);
  std::int64_t first_, side_;  // in tiles
  std::unordered_map<std::size_t, std::unique_ptr<std::uint8_t[]>> tiles_;
  std::uint64_t version_ = 0;
};

}  // namespace evigrid::driver
