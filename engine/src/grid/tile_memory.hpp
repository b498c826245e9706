// SPDX-License-Identifier: Apache-2.0
// Where tiles lie: the first few alone, then side by side in blocks of 2 MiB, which the system is asked to back by one
// large page each: a scan of a large map otherwise misses the address cache on every row of every tile. Room that is
// given back is used again; a block without a tile goes back to the system, but for one, which is kept for the next.
#pragma once
#include <cstddef>
#include <memory>
#include <vector>

namespace evigrid {

class TileMemory {
 public:
  struct Block;
  struct Room {
    float* at = nullptr;
    Block* block = nullptr;  // none: the tile lies alone
  };

  explicit TileMemory(std::size_t tile_bytes);
  ~TileMemory();
  TileMemory(const TileMemory&) = delete;
  TileMemory& operator=(const TileMemory&) = delete;

  [[nodiscard]] std::size_t tile_bytes() const noexcept { return tile_bytes_; }
  [[nodiscard]] std::size_t in_use() const noexcept { return in_use_; }  ///< tiles
  /// Room for one tile, 64-byte aligned, not set. Throws std::bad_alloc.
  Room take();
  void give_back(Room) noexcept;

 private:
  static constexpr std::size_t kAlone = 16;
  void release(Block*) noexcept;
  std::size_t tile_bytes_, in_use_ = 0;
  std::vector<std::unique_ptr<Block>> blocks_;
  std::vector<Block*> open_;  // those with room, the last one first
  Block* empty_ = nullptr;    // the one without a tile that is kept
};

}  // namespace evigrid
