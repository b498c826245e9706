// SPDX-License-Identifier: Apache-2.0
#include "life/edit.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "grid/cell_state.hpp"
#include "grid/decay.hpp"
#include "grid/readout.hpp"

namespace evigrid {
namespace {

constexpr int kSide = kernels::kTileSide, kCells = kernels::kMicroCells;

/// Tiles that exist in a rectangle, row by row: costs the rows and the tiles that it meets.
std::vector<Tile*> tiles_in(TileStore& store, const TileRect& r) {
  std::vector<Tile*> out;
  auto& tiles = store.tiles();
  for (auto it = tiles.lower_bound({r.first.y, r.first.x}); it != tiles.end() && it->first.y <= r.last.y;) {
    if (it->first.x < r.first.x) {
      it = tiles.lower_bound({it->first.y, r.first.x});
    } else if (it->first.x > r.last.x) {
      it = tiles.lower_bound({it->first.y + 1, r.first.x});
    } else {
      out.push_back(&it->second);
      ++it;
    }
  }
  return out;
}

/// One version: the tiles that go, the others were marked with next().
void commit(const Grid& g, const std::vector<Tile*>& gone, bool changed) {
  if (gone.empty() && !changed) return;
  g.changes.drop(gone);
  for (const Tile* t : gone) g.store.erase(TileIndex(t->index));
  g.changes.commit();
}

/// f(first plane of the cell, x, y) for the cells of a part of a tile.
template <class F>
void each_cell(const TileStore& store, const Tile& tile, const CellRect& part, F&& f) {
  for (std::int64_t y = part.y; y < part.y + part.height; ++y) {
    for (std::int64_t x = part.x; x < part.x + part.width; ++x)
      f(tile.cells + store.cell_offset(static_cast<int>(x), static_cast<int>(y)), x, y);
  }
}

BlockMask blocks_in(const CellRect& part) noexcept {
  BlockMask out = 0;
  for (std::int64_t y = part.y / kBlockSide; y <= (part.y + part.height - 1) / kBlockSide; ++y) {
    for (std::int64_t x = part.x / kBlockSide; x <= (part.x + part.width - 1) / kBlockSide; ++x)
      out |= BlockMask{1} << (y * kBlocksPerSide + x);
  }
  return out;
}

/// Room for the copies of those that must not be written where they are, before any of them is changed.
void own_all(TileStore& store, const std::vector<Tile*>& tiles) {
  for (Tile* t : tiles) store.pin(*t);
  store.reserve(static_cast<std::size_t>(
      std::count_if(tiles.begin(), tiles.end(), [&](const Tile* t) { return store.seen(*t); })));
  for (Tile* t : tiles) store.own(*t);
}

}  // namespace

void forget(const Grid& g, CellRect rect) {
  if (rect.empty()) return;
  g.store.begin_operation();
  std::vector<Tile*> gone, partly;
  for (Tile* t : tiles_in(g.store, tiles_of(rect))) (is_whole(part_in(rect, t->index)) ? gone : partly).push_back(t);
  own_all(g.store, partly);
  bool changed = false;
  for (Tile* t : partly) {
    const CellRect part = part_in(rect, t->index);
    each_cell(g.store, *t, part, [&](float* cell, auto, auto) {
      for (std::size_t p = 0; p < g.store.layout().planes.size(); ++p)
        cell[p * kCells] = g.store.layout().planes[p].vacuous;
    });
    if (g.store.is_vacuous(*t)) {
      gone.push_back(t);
      continue;
    }
    t->buffer->marks.mark(blocks_in(part), g.changes.next());
    g.changes.moved(*t);
    changed = true;
  }
  commit(g, gone, changed);
}

void drop_outside(const Grid& g, const TileRect& w) {
  constexpr auto kLeast = std::numeric_limits<std::int64_t>::min();
  std::vector<Tile*> gone;
  auto& tiles = g.store.tiles();
  for (auto it = tiles.begin(); it != tiles.end();) {
    const TileIndex at = it->first;
    if (!w.holds(at)) {
      gone.push_back(&it->second);
      ++it;
    } else {  // over what stays of this row
      it = w.last.x == std::numeric_limits<std::int64_t>::max() ? tiles.lower_bound({at.y + 1, kLeast})
                                                                : tiles.lower_bound({at.y, w.last.x + 1});
    }
  }
  commit(g, gone, false);
}

void freeze(const Grid& g, CellRect rect) {
  if (rect.empty() || g.store.layout().age < 0) return;
  g.store.begin_operation();
  const std::vector<Tile*> tiles = tiles_in(g.store, tiles_of(rect));
  own_all(g.store, tiles);
  for (Tile* t : tiles) {
    each_cell(g.store, *t, part_in(rect, t->index), [&](float* cell, std::int64_t x, std::int64_t y) {
      const Mass now = read_cell(g.store, {t->index.x * kSide + x, t->index.y * kSide + y}).mass;
      if (now == Mass{}) return;
      const CellPlanes s = state_of(g.params, now);
      for (int p = 0; p < g.store.layout().state; ++p) cell[p * kCells] = s.at[p];
      set_age(g.store.layout(), cell, {});
    });
    t->device_version = kNoVersion;
  }
}

void write(const Grid& g, CellRect rect, const std::function<const Mass*(std::int64_t, std::int64_t)>& of) {
  if (rect.empty()) return;
  g.store.begin_operation();
  const TileRect tiles = tiles_of(rect);
  std::vector<TileIndex> at;
  std::size_t room = 0;  // of tiles to be made and to be copied: a write that does not fit must not leave the former
  for (std::int64_t y = tiles.first.y; y <= tiles.last.y; ++y) {
    for (std::int64_t x = tiles.first.x; x <= tiles.last.x; ++x) {
      const TileIndex t{y, x};
      if (Tile* const there = g.store.find(t)) {
        g.store.pin(*there);
        room += static_cast<std::size_t>(g.store.seen(*there));
      } else {  // made only for what is known
        const CellRect part = part_in(rect, t);
        bool any = false;
        for (std::int64_t cy = part.y; cy < part.y + part.height && !any; ++cy) {
          for (std::int64_t cx = part.x; cx < part.x + part.width && !any; ++cx) {
            const Mass* const m = of(x * kSide + cx, y * kSide + cy);
            any = m != nullptr && !(*m == Mass{});
          }
        }
        if (!any) continue;
        ++room;
      }
      at.push_back(t);
    }
  }
  g.store.reserve(room);
  std::vector<Tile*> all;
  for (const TileIndex t : at) all.push_back(&g.store.get_or_make(t));
  own_all(g.store, all);
  const std::size_t planes = g.store.layout().planes.size();
  const auto state = static_cast<std::size_t>(g.store.layout().state);
  for (Tile* t : all) {
    const CellRect part = part_in(rect, t->index);
    each_cell(g.store, *t, part, [&](float* cell, std::int64_t x, std::int64_t y) {
      const Mass* const m = of(t->index.x * kSide + x, t->index.y * kSide + y);
      if (m == nullptr) return;
      const CellPlanes s = state_of(g.params, *m);
      for (std::size_t p = 0; p < planes; ++p)
        cell[p * kCells] = p < state ? s.at[p] : g.store.layout().planes[p].vacuous;
    });
    t->buffer->marks.mark(blocks_in(part), g.changes.next());
    g.changes.moved(*t);
  }
  commit(g, {}, !all.empty());
}

}  // namespace evigrid
