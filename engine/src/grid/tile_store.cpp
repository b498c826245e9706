// SPDX-License-Identifier: Apache-2.0
#include "grid/tile_store.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>

namespace evigrid {

TileStore::TileStore(CellLayout layout, std::size_t cap_bytes)
    : TileSource(std::make_shared<const CellLayout>(std::move(layout))),
      cap_bytes_(cap_bytes),
      ages_(std::make_shared<TileAges>(tile_bytes())) {}

TileStore::~TileStore() { clear(); }

void TileStore::clear() noexcept {
  for (auto& [at, tile] : tiles_) ages_->retire(tile.buffer);
  tiles_.clear();
  table_.clear();
  now_ns = std::numeric_limits<std::int64_t>::min();
  watch(false);
}

std::vector<TileRef> TileStore::in_order() const {
  std::vector<TileRef> out;
  out.reserve(tiles_.size());
  for (const auto& [at, tile] : tiles_) out.push_back({at, tile.cells});
  return out;
}

void TileStore::page_to(const std::filesystem::path& directory) {
  ages_->page_to(directory);
  pages_ = true;
}

/// First what only views see, for it is never written again; then tiles that changed longest ago. So many at a time
/// that looking for them costs little, and in the order of their places in memory, so that they are written one behind
/// the other. Views read on where a tile was.
void TileStore::page_out(std::size_t least) {
  constexpr std::size_t kShare = 8;  // of what the cap holds
  const std::size_t enough = std::max(least, cap_bytes_ / tile_bytes() / kShare);
  const std::size_t old = ages_->page_out_retired(enough);
  if (old >= enough) return;
  std::vector<Tile*> cold;
  for (auto& [at, tile] : tiles_) {
    if (tile.batch != operation_ && !tile.buffer->room.paged && tile.buffer->room.block != nullptr)
      cold.push_back(&tile);
  }
  const std::size_t n = std::min(enough - old, cold.size());
  const auto longer_ago = [](const Tile* a, const Tile* b) {
    return a->buffer->marks.last != b->buffer->marks.last ? a->buffer->marks.last < b->buffer->marks.last
                                                          : a->index < b->index;
  };
  const auto end = cold.begin() + static_cast<std::ptrdiff_t>(n);
  std::nth_element(cold.begin(), end, cold.end(), longer_ago);
  std::sort(cold.begin(), end, [](const Tile* a, const Tile* b) { return std::less<>{}(a->cells, b->cells); });
  std::for_each(cold.begin(), end, [&](Tile* t) { ages_->page_out(t->buffer); });
}

void TileStore::reserve(std::size_t more) {
  if (more == 0) return;
  const std::size_t most = cap_bytes_ / tile_bytes();
  std::size_t all = ages_->count().resident + more;
  if (all > most && pages_) {
    page_out(all - most);
    all = ages_->count().resident + more;
  }
  if (all > most) {
    throw std::length_error("map.memory_cap_bytes: " + std::to_string(all) + " tiles of " +
                            std::to_string(tile_bytes()) + " bytes" +
                            (ages_->any_view() ? ", those that views hold among them," : "") + " do not fit under " +
                            std::to_string(cap_bytes_));
  }
}

Tile& TileStore::get_or_make(TileIndex at) {
  const auto [it, made] = tiles_.try_emplace(at);
  Tile& tile = it->second;
  pin(tile);
  if (made) {
    tile.index = at;
    try {
      tile.buffer = ages_->make();
      tile.cells = tile.buffer->cells();
      table_.insert(at, &tile);
      note(at);
    } catch (...) {
      table_.erase(at);
      if (tile.buffer != nullptr) ages_->retire(tile.buffer);
      tiles_.erase(it);
      throw;
    }
    set_vacuous(tile);
  }
  return tile;
}

/// Nobody asks for long, or there is no memory: who asks then begins anew.
void TileStore::note(TileIndex at) noexcept {
  constexpr std::size_t kMost = 1 << 16;
  if (!watched_) return;
  if (moved_.size() >= kMost) return watch(false);
  try {
    moved_.push_back(at);
  } catch (...) {
    watch(false);
  }
}

void TileStore::set_vacuous(Tile& tile) noexcept {
  float* p = tile.cells;
  for (int micro = 0; micro < kernels::kMicrosPerTile; ++micro) {
    for (const Plane& plane : layout().planes) {
      for (int i = 0; i < kernels::kMicroCells; ++i) *p++ = plane.vacuous;
    }
  }
}

bool TileStore::is_vacuous(const Tile& tile) const noexcept {
  const float* p = tile.cells;
  for (int micro = 0; micro < kernels::kMicrosPerTile; ++micro) {
    for (const Plane& plane : layout().planes) {
      for (int i = 0; i < kernels::kMicroCells; ++i) {
        if (*p++ != plane.vacuous) return false;
      }
    }
  }
  return true;
}

void TileStore::erase(TileIndex at) noexcept {
  const auto it = tiles_.find(at);
  if (it == tiles_.end()) return;
  ages_->retire(it->second.buffer);
  table_.erase(at);
  tiles_.erase(it);
  note(at);
}

void TileStore::replace(Tile& tile, TileBuffer* copy) noexcept {
  ages_->retire(tile.buffer);
  tile.buffer = copy;
  tile.cells = copy->cells();
  note(tile.index);
}

void TileStore::own(Tile& tile) {
  pin(tile);
  if (!seen(tile)) return;
  reserve(1);
  TileBuffer* const copy = make_buffer();
  std::memcpy(copy->cells(), tile.cells, tile_bytes());
  copy->marks = tile.buffer->marks;
  replace(tile, copy);
}

}  // namespace evigrid
