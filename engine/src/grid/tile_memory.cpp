// SPDX-License-Identifier: Apache-2.0
#include "grid/tile_memory.hpp"

#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace evigrid {

void FreeAligned::operator()(float* p) const noexcept { std::free(p); }

float* TileMemory::take() {
  constexpr std::size_t kBlock = std::size_t{2} << 20;
  if (left_ == 0) {
    const bool alone = taken_ < kAlone || tile_bytes_ > kBlock / 4;
    const std::size_t alignment = alone ? 64 : kBlock, bytes = alone ? tile_bytes_ : kBlock;
    blocks_.emplace_back(static_cast<float*>(std::aligned_alloc(alignment, bytes)));
    next_ = blocks_.back().get();
    if (next_ == nullptr) {
      blocks_.pop_back();
      throw std::bad_alloc();
    }
#ifdef __linux__
    if (!alone) madvise(next_, bytes, MADV_HUGEPAGE);  // a wish: refused, the block is as good as any
#endif
    left_ = bytes / tile_bytes_;
  }
  float* const p = next_;
  next_ += tile_bytes_ / sizeof(float);
  --left_;
  ++taken_;
  return p;
}

void TileMemory::clear() noexcept {
  blocks_.clear();
  taken_ = left_ = 0;
  next_ = nullptr;
}

}  // namespace evigrid
