// SPDX-License-Identifier: Apache-2.0
#include "grid/tile_store.hpp"

#include <stdexcept>
#include <string>

namespace evigrid {

TileStore::TileStore(CellLayout layout, std::size_t cap_bytes)
    : layout_(std::move(layout)),
      planes_(static_cast<int>(layout_.planes.size())),
      cap_bytes_(cap_bytes),
      memory_(tile_bytes()) {}

std::size_t TileStore::tile_bytes() const noexcept {
  return static_cast<std::size_t>(kernels::kTileSide * kernels::kTileSide * planes_) * sizeof(float);
}

void TileStore::clear() noexcept {
  tiles_.clear();
  table_.clear();
  memory_.clear();
  now_ns = std::numeric_limits<std::int64_t>::min();
}

void TileStore::reserve(std::size_t more) const {
  if ((size() + more) * tile_bytes() > cap_bytes_) {
    throw std::length_error("map.memory_cap_bytes: " + std::to_string(size() + more) + " tiles of " +
                            std::to_string(tile_bytes()) + " bytes do not fit under " + std::to_string(cap_bytes_));
  }
}

Tile& TileStore::get_or_make(TileIndex at) {
  const auto [it, made] = tiles_.try_emplace(at);
  Tile& tile = it->second;
  if (made) {
    tile.index = at;
    try {
      tile.cells.reset(memory_.take());
      table_.insert(at, &tile);
    } catch (...) {
      tiles_.erase(it);
      throw;
    }
    float* p = tile.cells.get();
    for (int micro = 0; micro < kernels::kMicrosPerTile; ++micro) {
      for (const Plane& plane : layout_.planes) {
        for (int i = 0; i < kernels::kMicroCells; ++i) *p++ = plane.vacuous;
      }
    }
  }
  return tile;
}

}  // namespace evigrid
