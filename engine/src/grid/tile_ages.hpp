// SPDX-License-Identifier: Apache-2.0
// Who may still read a tile's buffer. Every view begins a new age: it sees the buffers born up to its own age that had
// not died by then. So one number says whether the writer must copy before it writes, making a view touches no tile,
// and there is nothing to count on the writer's way. A buffer that died is freed with the last view that sees it, in
// that view's thread.
#pragma once
#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "grid/tile_buffer.hpp"

namespace evigrid {

class TileAges {
 public:
  explicit TileAges(std::size_t tile_bytes) : memory_(tile_bytes) {}
  ~TileAges();
  TileAges(const TileAges&) = delete;
  TileAges& operator=(const TileAges&) = delete;

  // The writer's.
  [[nodiscard]] std::uint64_t now() const noexcept { return now_; }
  [[nodiscard]] bool any_view() const noexcept { return newest_.load(std::memory_order_acquire) != 0; }
  /// Whether a view that lives may read what was born then.
  [[nodiscard]] bool seen(std::uint64_t born) const noexcept { return born <= newest_.load(std::memory_order_acquire); }
  /// Born now, cells not set. Throws std::bad_alloc.
  TileBuffer* make();
  /// The map has it no longer.
  void retire(TileBuffer*) noexcept;
  /// A file for cold tiles (tile_memory.hpp), and one of them put there: it can still be read by everybody.
  void page_to(const std::filesystem::path& directory);
  bool page_out(TileBuffer*);
  /// Of those that only views see at most so many; answers how many.
  std::size_t page_out_retired(std::size_t most);
  /// The age that a new view sees; the next one begins.
  std::uint64_t open_view();

  // Anybody's.
  void close_view(std::uint64_t age) noexcept;
  /// Buffers, those that only views see among them: in memory, and in the page file.
  struct Count {
    std::size_t resident, paged;
  };
  [[nodiscard]] Count count() const;

 private:
  [[nodiscard]] bool seen_between(std::uint64_t born, std::uint64_t died) const noexcept;
  void free(TileBuffer*) noexcept;
  mutable std::mutex mutex_;
  TileMemory memory_;
  std::uint64_t now_ = 1;
  std::atomic<std::uint64_t> newest_{0};  // age of the newest view that lives, 0: none
  std::vector<std::uint64_t> views_;      // ages of those that live, ascending
  std::vector<TileBuffer*> retired_;      // seen by some of them
};

}  // namespace evigrid
