// SPDX-License-Identifier: Apache-2.0
#include "io/region.hpp"

#include <algorithm>
#include <limits>

#include "grid/tile_source.hpp"
#include "io/map_access.hpp"
#include "life/edit.hpp"

namespace evigrid::io {
namespace {

constexpr std::int64_t kSide = kernels::kTileSide;

/// Cells from first to last, inclusive: the widest rectangle has ends, though its far one may not fit 64 bits.
struct Ends {
  std::int64_t first, last;
};
Ends ends(std::int64_t first, std::int64_t length) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  return {first, first > 0 && length - 1 > kMost - first ? kMost : first + (length - 1)};
}
/// What of it a tile has, in cells of the map: half-open, first == last where nothing.
Ends within(const Ends& e, std::int64_t tile) {
  return {std::clamp(e.first, tile * kSide, (tile + 1) * kSide),
          std::clamp(e.last, tile * kSide - 1, (tile + 1) * kSide - 1) + 1};
}

}  // namespace

void keep_region(std::vector<Entry>& entries, const CellRect& region) {
  if (region.empty()) return entries.clear();
  const Ends x = ends(region.x, region.width), y = ends(region.y, region.height);
  const auto meets = [](const Ends& e, std::int64_t tile) {
    return tile >= tile_coordinate(e.first) && tile <= tile_coordinate(e.last);
  };
  std::erase_if(entries, [&](const Entry& e) { return !meets(x, e.x) || !meets(y, e.y); });
}

void clear_around(Map& map, std::span<const Entry> entries, const CellRect& region) {
  if (region.empty()) return;
  // Not Map::clear: what it accepts ends at 2^60 cells, the tiles of a file a tile farther.
  const Grid grid{map.params(), MapAccess::store(map), MapAccess::changes(map)};
  const auto clear = [&](const CellRect& r) { forget(grid, r); };
  const Ends rx = ends(region.x, region.width), ry = ends(region.y, region.height);
  for (const Entry& e : entries) {
    const Ends x = within(rx, e.x), y = within(ry, e.y);
    const std::int64_t left = e.x * kSide, bottom = e.y * kSide;
    clear({left, bottom, kSide, y.first - bottom});
    clear({left, y.last, kSide, bottom + kSide - y.last});
    clear({left, y.first, x.first - left, y.last - y.first});
    clear({x.last, y.first, left + kSide - x.last, y.last - y.first});
  }
}

}  // namespace evigrid::io
