// SPDX-License-Identifier: Apache-2.0
#include "life/refuse.hpp"

#include <algorithm>
#include <cstring>

#include "integrate.hpp"
#include "io/map_access.hpp"
#include "scan/gate.hpp"
#include "scratch.hpp"

namespace evigrid {

std::vector<std::vector<TileIndex>> tiles_reached(const Map& map, std::size_t scans) {
  const Scratch& s = MapAccess::scratch(map);
  std::vector<std::vector<TileIndex>> out(scans);
  for (const Reach& r : s.plan.reaches) {
    const auto scan = std::upper_bound(s.scan_end.begin(), s.scan_end.end(), std::size_t{r.footprint});
    out[static_cast<std::size_t>(scan - s.scan_end.begin())].push_back(s.plan.tiles[r.tile].at);
  }
  for (auto& tiles : out) {
    std::sort(tiles.begin(), tiles.end());
    tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
  }
  return out;
}

std::vector<TileIndex> tiles_of_scan(Map& map, const Scan& scan) {
  const Pipeline p = MapAccess::pipeline(map);
  Scratch& s = MapAccess::scratch(map);
  s.footprints.clear();
  Report ignored;
  gate_scan(scan, p.sensors, p.params, s.footprints, ignored);
  bin(s.footprints, p.table, p.store, p.admission, Missing::made, p.executor, s.plan);
  std::vector<TileIndex> out;
  for (const TileWork& w : s.plan.tiles) out.push_back(w.at);
  return out;
}

void put_back(Map& map, const TileSet& tiles, const MapView& view) {
  TileStore& store = MapAccess::store(map);
  ChangeLog& changes = MapAccess::changes(map);
  const TileSource& then = MapAccess::source(view);
  struct Fresh {
    TileStore& store;
    std::vector<Tile*> tiles;
    std::vector<TileBuffer*> buffers;
    ~Fresh() {
      for (TileBuffer* b : buffers) {
        if (b != nullptr) store.drop_buffer(b);
      }
    }
  } fresh{store, {}, {}};
  std::size_t room = 0;
  store.begin_operation();
  for (const TileIndex at : tiles) {
    Tile* const tile = store.find(at);
    if (tile != nullptr) store.pin(*tile);
    room += static_cast<std::size_t>(tile == nullptr || store.seen(*tile));
  }
  store.reserve(room);
  for (const TileIndex at : tiles) {
    Tile& tile = store.get_or_make(at);
    fresh.tiles.push_back(&tile);
    fresh.buffers.push_back(store.seen(tile) ? store.make_buffer() : nullptr);
  }
  for (std::size_t i = 0; i < fresh.tiles.size(); ++i) {
    Tile& tile = *fresh.tiles[i];
    if (fresh.buffers[i] != nullptr) {
      fresh.buffers[i]->marks = tile.buffer->marks;
      store.replace(tile, fresh.buffers[i]);
    }
    if (const float* cells = then.cells_of(tile.index)) {
      std::memcpy(tile.cells, cells, store.tile_bytes());
    } else {
      store.set_vacuous(tile);
    }
    tile.buffer->marks.mark(~BlockMask{0}, changes.next());
    changes.moved(tile);
  }
  fresh.buffers.clear();
  if (!fresh.tiles.empty()) changes.commit();
}

void reserve_to_refuse(Map& map, std::size_t tiles) {
  TileStore& store = MapAccess::store(map);
  if (store.pages()) return;  // what only views hold goes to the file
  std::size_t all = tiles;
  for (const auto& [at, tile] : store.tiles()) all += static_cast<std::size_t>(store.seen(tile));
  if (all > store.size()) store.reserve(all - store.size());
}

Report integrate_on(Map& map, const TileSet& tiles, std::span<const Scan> scans) {
  struct Only {
    Admission& admission;
    explicit Only(Admission& a, const TileSet& t) : admission(a) { admission.only = &t; }
    ~Only() { admission.only = nullptr; }
  } only(MapAccess::admission(map), tiles);
  return map.integrate(scans);
}

void drop_tiles(Map& map, const TileSet& tiles) {
  TileStore& store = MapAccess::store(map);
  std::vector<Tile*> gone;
  for (const TileIndex at : tiles) {
    if (Tile* tile = store.find(at)) gone.push_back(tile);
  }
  if (gone.empty()) return;
  MapAccess::changes(map).drop(gone);
  for (const Tile* t : gone) store.erase(TileIndex(t->index));
  MapAccess::changes(map).commit();
}

TileSet all_tiles(const Map& map) {
  TileSet out;
  for (const TileRef& t : MapAccess::source(map).in_order()) out.insert(t.at);
  return out;
}
bool is_vacuous(const Map& map, TileIndex at) noexcept {
  const auto& store = static_cast<const TileStore&>(MapAccess::source(map));
  const Tile* tile = store.find(at);
  return tile == nullptr || store.is_vacuous(*tile);
}
bool has_tile(const MapView& view, TileIndex at) noexcept { return MapAccess::source(view).cells_of(at) != nullptr; }

std::int64_t last_stamp(const Map& map) noexcept { return MapAccess::last_stamp_ns(map); }
void set_last_stamp(Map& map, std::int64_t stamp_ns) { MapAccess::last_stamp_ns(map) = stamp_ns; }

}  // namespace evigrid
