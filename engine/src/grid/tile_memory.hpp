// SPDX-License-Identifier: Apache-2.0
// Where tiles lie: the first few alone, then side by side in blocks of 2 MiB, which the system is asked to back by one
// large page each: a scan of a large map otherwise misses the address cache on every row of every tile.
#pragma once
#include <cstddef>
#include <memory>
#include <vector>

namespace evigrid {

struct FreeAligned {
  void operator()(float*) const noexcept;
};

class TileMemory {
 public:
  explicit TileMemory(std::size_t tile_bytes) : tile_bytes_(tile_bytes) {}
  /// Room for one tile, 64-byte aligned, not set; lives as long as this, or until clear(). Throws std::bad_alloc.
  float* take();
  void clear() noexcept;

 private:
  static constexpr std::size_t kAlone = 16;
  std::size_t tile_bytes_, taken_ = 0, left_ = 0;  // left_: tiles that fit behind next_
  float* next_ = nullptr;
  std::vector<std::unique_ptr<float[], FreeAligned>> blocks_;
};

}  // namespace evigrid
