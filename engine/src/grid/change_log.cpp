// SPDX-License-Identifier: Apache-2.0
#include "grid/change_log.hpp"

#include <algorithm>
#include <bit>

namespace evigrid {
namespace {

/// Box of the blocks that changed after `version`, in cells of the map.
CellRect changed_box(const TileChange& tile, std::uint64_t version) {
  int x0 = kBlocksPerSide, x1 = -1, y0 = kBlocksPerSide, y1 = -1;
  for (int y = 0; y < kBlocksPerSide; ++y) {
    for (int x = 0; x < kBlocksPerSide; ++x) {
      if (tile.version[static_cast<std::size_t>(y * kBlocksPerSide + x)] <= version) continue;
      x0 = std::min(x0, x), x1 = std::max(x1, x);
      y0 = std::min(y0, y), y1 = std::max(y1, y);
    }
  }
  return {tile.at.x * kernels::kTileSide + x0 * kBlockSide, tile.at.y * kernels::kTileSide + y0 * kBlockSide,
          (x1 - x0 + 1) * kBlockSide, (y1 - y0 + 1) * kBlockSide};
}

}  // namespace

void TileChange::mark(BlockMask blocks, std::uint64_t now) noexcept {
  if (blocks == 0) return;
  last = now;
  for (; blocks != 0; blocks &= blocks - 1) version[static_cast<std::size_t>(std::countr_zero(blocks))] = now;
}

void ChangeLog::enroll(Tile& tile) {
  if (tile.change != nullptr) return;
  tile.change = &records_.emplace_back();
  tile.change->at = tile.index;
}

void ChangeLog::moved(TileChange& r) noexcept {
  if (newest_ == &r) return;
  if (r.newer != nullptr) {  // chained already: take it out
    r.newer->older = r.older;
    (r.older != nullptr ? r.older->newer : oldest_) = r.newer;
  }
  r.newer = nullptr;
  r.older = newest_;
  (newest_ != nullptr ? newest_->newer : oldest_) = &r;
  newest_ = &r;
}

void ChangeLog::clear() noexcept {
  records_.clear();
  newest_ = oldest_ = nullptr;
  cleared_ = ++version_;
}

Changes ChangeLog::since(std::uint64_t version) const {
  Changes out;
  out.version = version_;
  out.cleared = version < cleared_;
  for (const TileChange* r = newest_; r != nullptr && r->last > version; r = r->older)
    out.rects.push_back(changed_box(*r, version));
  return out;
}

}  // namespace evigrid
