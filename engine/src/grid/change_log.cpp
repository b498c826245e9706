// SPDX-License-Identifier: Apache-2.0
#include "grid/change_log.hpp"

#include <algorithm>
#include <bit>

namespace evigrid {

CellRect changed_box(TileIndex at, const TileMarks& tile, std::uint64_t version) noexcept {
  int x0 = kBlocksPerSide, x1 = -1, y0 = kBlocksPerSide, y1 = -1;
  for (int y = 0; y < kBlocksPerSide; ++y) {
    for (int x = 0; x < kBlocksPerSide; ++x) {
      if (tile.version[static_cast<std::size_t>(y * kBlocksPerSide + x)] <= version) continue;
      x0 = std::min(x0, x), x1 = std::max(x1, x);
      y0 = std::min(y0, y), y1 = std::max(y1, y);
    }
  }
  return {at.x * kernels::kTileSide + x0 * kBlockSide, at.y * kernels::kTileSide + y0 * kBlockSide,
          (x1 - x0 + 1) * kBlockSide, (y1 - y0 + 1) * kBlockSide};
}

CellRect whole_box(TileIndex at) noexcept {
  constexpr std::int64_t kSide = kernels::kTileSide;
  return {at.x * kSide, at.y * kSide, kSide, kSide};
}

void TileMarks::mark(BlockMask blocks, std::uint64_t now) noexcept {
  if (blocks == 0) return;
  last = now;
  for (; blocks != 0; blocks &= blocks - 1) version[static_cast<std::size_t>(std::countr_zero(blocks))] = now;
}

Changes begin_changes(const Losses& losses, std::uint64_t since) {
  Changes out;
  out.version = losses.version;
  out.cleared = since < losses.cleared;
  if (losses.dropped) {
    for (auto d = losses.dropped->rbegin(); d != losses.dropped->rend() && d->version > since; ++d)
      out.rects.push_back(whole_box(d->at));
  }
  return out;
}

void ChangeLog::unchain(Tile& t) noexcept {
  if (t.newer != nullptr || newest_ == &t) {
    (t.newer != nullptr ? t.newer->older : newest_) = t.older;
    (t.older != nullptr ? t.older->newer : oldest_) = t.newer;
  }
  t.newer = t.older = nullptr;
}

void ChangeLog::moved(Tile& t) {
  if (t.fresh) {
    t.fresh = false;
    const auto same = [&](const Dropped& d) { return d.at == t.index; };
    if (losses_.dropped && std::any_of(losses_.dropped->begin(), losses_.dropped->end(), same)) {
      auto left = std::make_shared<std::vector<Dropped>>(*losses_.dropped);  // views keep the list they know
      std::erase_if(*left, same);
      losses_.dropped = std::move(left);
      t.buffer->marks.mark(~BlockMask{0}, next());  // it comes back: all of it is new
    }
  }
  if (newest_ == &t) return;
  unchain(t);
  t.older = newest_;
  (newest_ != nullptr ? newest_->newer : oldest_) = &t;
  newest_ = &t;
}

void ChangeLog::drop(std::span<Tile* const> tiles) {
  if (tiles.empty()) return;
  auto all = std::make_shared<std::vector<Dropped>>();
  if (losses_.dropped) *all = *losses_.dropped;
  for (const Tile* t : tiles) {
    if (!t->fresh) all->push_back({t->index, next()});  // else it never changed, or is listed from before
  }
  if (all->size() > kMostDropped) {
    const auto end = all->end() - kMostDropped;
    losses_.cleared = std::max(losses_.cleared, (end - 1)->version);
    all->erase(all->begin(), end);
  }
  losses_.dropped = std::move(all);
  for (Tile* t : tiles) unchain(*t);
}

void ChangeLog::clear() noexcept {
  newest_ = oldest_ = nullptr;
  losses_.dropped.reset();
  losses_.cleared = ++losses_.version;
}

Changes ChangeLog::since(std::uint64_t version) const {
  Changes out = begin_changes(losses_, version);
  version = listed_since(out, version);
  for (const Tile* t = newest_; t != nullptr && t->buffer->marks.last > version; t = t->older)
    out.rects.push_back(changed_box(t->index, t->buffer->marks, version));
  return out;
}

}  // namespace evigrid
