// SPDX-License-Identifier: Apache-2.0
// From tiles to the rows of a caller's array: strips of four rows as they are now, and what is asked of each cell,
// micro-tile by micro-tile.
#pragma once
#include <algorithm>
#include <span>

#include "evigrid/map.hpp"
#include "grid/decay.hpp"
#include "grid/rect.hpp"
#include "grid/tile_source.hpp"

namespace evigrid::rows {

inline constexpr int kSide = kernels::kTileSide, kMicro = kernels::kMicroSide, kCells = kernels::kMicroCells;
inline constexpr float kZeros[kCells] = {};

/// The planes of micro-tiles beside each other: where they lie or, in maps that forget, a copy as they are now.
class PresentCells {
 public:
  /// `micros` of them from that of cell (x, y) of the tile on. Valid until the next call.
  const float* read(const TileSource& store, const float* tile, int x, int y, int micros) noexcept {
    const float* cells = tile + store.cell_offset(x & ~3, y & ~3);
    if (store.layout().age < 0) return cells;
    std::copy_n(cells, store.cell_offset(kMicro, 0) * static_cast<std::size_t>(micros), copy_);
    age_masses(store.layout(), store.planes(), store.now_ns, copy_, micros);
    return copy_;
  }
  const float* row(const TileSource& store, const float* tile, int y) noexcept {
    return read(store, tile, 0, y, kernels::kMicrosPerSide);
  }

 private:
  alignas(64) float copy_[kernels::kMicrosPerSide * kMostForgettingPlanes * kCells];
};

/// The masses of four rows of a tile's cells: the unit of reading. Micro-tiles beside each other lie one after the
/// other, so it is one call of the kernel.
struct Strip {
  alignas(64) float masses[kernels::kMicrosPerSide * 4 * kCells];
  PresentCells cells;

  void read(const TileSource& store, const float* tile, int y) {
    store.layout().read_out(cells.row(store, tile, y), store.planes(), kernels::kMicrosPerSide, masses);
  }
  [[nodiscard]] Mass at(int x, int y) const noexcept {
    const float* p = masses + (x / kMicro) * 4 * kCells + (y % kMicro) * kMicro + x % kMicro;
    return {p[0], p[kCells], p[2 * kCells], p[3 * kCells]};
  }
};

/// A micro-tile as read: its masses, and the history that the map keeps, 16 cells each (zeros where it keeps none).
struct Micro {
  const float *e, *o, *u, *c, *k, *con, *last;
};

/// The part of `rect` in one tile, micro-tile by micro-tile: of(micro, out) makes 16 values, straight from the planes
/// where these are masses so that the compiler sees vectors; those within the rectangle go to their rows. `part` lies
/// in the tile.
template <class T, class F>
void fill_tile(const TileSource& store, const float* cells, CellRect part, T* to, std::ptrdiff_t stride, F&& of) {
  const int x0 = static_cast<int>(part.x & 63), x1 = x0 + static_cast<int>(part.width);
  const int y0 = static_cast<int>(part.y & 63), y1 = y0 + static_cast<int>(part.height);
  const CellLayout& l = store.layout();
  Strip strip;
  T values[kCells];
  for (int my = y0 & ~3; my < y1; my += kMicro) {
    if (!l.planes_are_masses) strip.read(store, cells, my);
    const float* const row = strip.cells.row(store, cells, my);
    for (int mx = x0 & ~3; mx < x1; mx += kMicro) {
      const float* p = row + store.cell_offset(mx, 0);
      const auto kept = [&](int plane) { return plane < 0 ? kZeros : p + plane * kCells; };
      const float* masses = l.planes_are_masses ? p : strip.masses + (mx / kMicro) * 4 * kCells;
      const float* c = l.planes_are_masses ? kept(l.paradox) : masses + 3 * kCells;
      of(Micro{masses, masses + kCells, masses + 2 * kCells, c, kept(l.conflict), kept(l.con), kept(l.last_conflict)},
         values);
      const int left = std::max(mx, x0), right = std::min(mx + kMicro, x1);
      for (int y = std::max(my, y0); y < std::min(my + kMicro, y1); ++y)
        std::copy_n(values + (y - my) * kMicro + (left - mx), right - left, to + (y - y0) * stride + (left - x0));
    }
  }
}

/// Tile by tile into the caller's buffer: tile(cells, part of the rectangle, out) fills its part; `never_seen` where
/// there is none.
template <class T, class F>
void fill(const TileSource& store, CellRect rect, std::span<T> out, std::ptrdiff_t stride, T never_seen, F&& tile) {
  if (rect.empty()) return;
  require_room("render", rect, out.size(), stride);
  const std::int64_t x_end = rect.x + rect.width, y_end = rect.y + rect.height;
  for (std::int64_t y = rect.y; y < y_end;) {
    const std::int64_t below = std::min((tile_coordinate(y) + 1) * kSide, y_end);
    for (std::int64_t x = rect.x; x < x_end;) {
      const std::int64_t right = std::min((tile_coordinate(x) + 1) * kSide, x_end);
      T* to = out.data() + (y - rect.y) * stride + (x - rect.x);
      if (const float* cells = store.cells_of(tile_of(x, y))) {
        tile(cells, CellRect{x, y, right - x, below - y}, to);
      } else {
        for (std::int64_t row = 0; row < below - y; ++row) std::fill_n(to + row * stride, right - x, never_seen);
      }
      x = right;
    }
    y = below;
  }
}

}  // namespace evigrid::rows
