// SPDX-License-Identifier: Apache-2.0
// Where tiles lie: the first few alone, then side by side in blocks of 2 MiB, which the system is asked to back by one
// large page each: a scan of a large map otherwise misses the address cache on every row of every tile. Room that is
// given back is used again; a block without a tile goes back to the system, but for one, which is kept for the next.
// Tiles in blocks can be paged to a file (page_file.hpp): they stay where they are, can be read and no longer written.
#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "grid/page_file.hpp"

namespace evigrid {

class TileMemory {
 public:
  struct Block;
  struct Room {
    float* at = nullptr;
    Block* block = nullptr;  // none: the tile lies alone
    bool paged = false;
  };

  explicit TileMemory(std::size_t tile_bytes);
  ~TileMemory();
  TileMemory(const TileMemory&) = delete;
  TileMemory& operator=(const TileMemory&) = delete;

  [[nodiscard]] std::size_t tile_bytes() const noexcept { return tile_bytes_; }
  [[nodiscard]] std::size_t in_use() const noexcept { return in_use_; }  ///< tiles, paged ones among them
  [[nodiscard]] std::size_t paged() const noexcept { return paged_; }
  /// Room for one tile, 64-byte aligned, not set. Throws std::bad_alloc.
  Room take();
  void give_back(Room) noexcept;

  /// Throws std::system_error, std::invalid_argument when tiles of this size cannot be paged.
  void page_to(const std::filesystem::path& directory);
  /// False when the tile cannot be: it lies alone, or is paged. Throws std::system_error.
  bool page_out(Room&);

 private:
  static constexpr std::size_t kAlone = 16;
  void release(Block*) noexcept;
  [[nodiscard]] std::uint64_t place_in_file(const Room&) const noexcept;
  std::size_t tile_bytes_, in_use_ = 0, paged_ = 0;
  std::unique_ptr<PageFile> file_;
  std::vector<std::unique_ptr<Block>> blocks_;
  std::vector<Block*> open_;  // those with room, the last one first
  Block* empty_ = nullptr;    // the one without a tile that is kept
};

}  // namespace evigrid
