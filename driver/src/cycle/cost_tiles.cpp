// SPDX-License-Identifier: Apache-2.0
#include "cycle/cost_tiles.hpp"

#include <algorithm>
#include <span>

namespace evigrid::driver {

CostTiles::CostTiles(std::int64_t side_cells, std::int64_t border_cells)
    : first_(-((border_cells + kSide - 1) / kSide)), side_((side_cells + kSide - 1) / kSide - 2 * first_) {}

std::size_t CostTiles::index(std::int64_t x, std::int64_t y) const {
  const std::int64_t tx = (x >> 6) - first_, ty = (y >> 6) - first_;
  return tx < 0 || ty < 0 || tx >= side_ || ty >= side_ ? kOutside : static_cast<std::size_t>(ty * side_ + tx);
}

std::uint8_t CostTiles::at(std::int64_t x, std::int64_t y) const {
  const auto tile = tiles_.find(index(x, y));
  return tile == tiles_.end() ? std::uint8_t{255} : tile->second[static_cast<std::size_t>((y & 63) * kSide + (x & 63))];
}

std::size_t CostTiles::memory_bytes() const {
  return tiles_.size() * (static_cast<std::size_t>(kSide * kSide) + sizeof(*tiles_.begin())) +
         tiles_.bucket_count() * sizeof(void*);
}

Rendered CostTiles::update(const Map& map, Executor& executor) {
  constexpr std::size_t kChunk = 8;  // rectangles a task
  Changes changes = map.changes(version_);
  version_ = changes.version;
  if (changes.cleared) {
    tiles_.clear();
  }
  Rendered out;
  std::erase_if(changes.rects, [&](const CellRect& r) { return index(r.x, r.y) == kOutside; });
  for (const CellRect& r : changes.rects) {
    auto& tile = tiles_[index(r.x, r.y)];
    if (!tile) {
      tile = std::make_unique_for_overwrite<std::uint8_t[]>(static_cast<std::size_t>(kSide * kSide));
      std::fill_n(tile.get(), kSide * kSide, std::uint8_t{255});
    }
    ++out.tiles;
    out.cells += static_cast<std::uint64_t>(r.width * r.height);
  }
  struct Job {
    CostTiles& costs;
    const Map& map;
    const std::vector<CellRect>& rects;
  } job{*this, map, changes.rects};
  executor.run(
      static_cast<std::int64_t>((changes.rects.size() + kChunk - 1) / kChunk),
      [](void* context, std::int64_t chunk, int) {
        const Job& j = *static_cast<const Job*>(context);
        const std::size_t begin = static_cast<std::size_t>(chunk) * kChunk;
        for (std::size_t i = begin; i < std::min(begin + kChunk, j.rects.size()); ++i) {
          const CellRect& r = j.rects[i];
          const auto inside = static_cast<std::size_t>((r.y & 63) * kSide + (r.x & 63));
          const std::span<std::uint8_t> tile(j.costs.tiles_.at(j.costs.index(r.x, r.y)).get(),
                                             static_cast<std::size_t>(kSide * kSide));
          j.map.render(Costmap{}, r, tile.subspan(inside), kSide);
        }
      },
      &job);
  return out;
}

}  // namespace evigrid::driver
