// SPDX-License-Identifier: Apache-2.0
// The sparse grid: tiles of 64 × 64 cells, made when a reading first reaches them. Their inside is the kernels' layout
// (kernel_table.hpp); nothing else of the engine looks into it but `cell_offset`.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>

#include "grid/cell_layout.hpp"
#include "grid/tile_index.hpp"
#include "grid/tile_memory.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid {

inline std::int64_t tile_coordinate(std::int64_t cell) noexcept { return cell >> 6; }
inline TileIndex tile_of(std::int64_t x, std::int64_t y) noexcept { return {tile_coordinate(y), tile_coordinate(x)}; }
/// Offset of the first cell centre of tile coordinate `t` from an apex at cell i0 plus f.
inline double offset(std::int64_t t, std::int64_t i0, float f) noexcept {
  return static_cast<double>(t * kernels::kTileSide - i0) - static_cast<double>(f);
}

struct TileChange;

/// Cells of a tile; the store's memory owns them.
class TileCells {
 public:
  [[nodiscard]] float* get() const noexcept { return at_; }
  void reset(float* at) noexcept { at_ = at; }

 private:
  float* at_ = nullptr;
};

struct Tile {
  TileIndex index;
  TileCells cells;
  std::uint64_t batch = 0;  // the last batch of scans that reached it, and its place among that batch's tiles
  std::uint32_t place = 0;
  TileChange* change = nullptr;  // change_log.hpp
};

class TileStore {
 public:
  TileStore(CellLayout layout, std::size_t cap_bytes);
  [[nodiscard]] const CellLayout& layout() const noexcept { return layout_; }
  [[nodiscard]] int planes() const noexcept { return planes_; }
  [[nodiscard]] std::size_t tile_bytes() const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return tiles_.size(); }
  [[nodiscard]] std::size_t bytes() const noexcept { return size() * tile_bytes(); }
  [[nodiscard]] const Tile* find(TileIndex at) const noexcept { return table_.find(at); }
  [[nodiscard]] Tile* find(TileIndex at) noexcept { return table_.find(at); }
  /// Throws std::length_error when `more` further tiles would not fit under the cap.
  void reserve(std::size_t more) const;
  Tile& get_or_make(TileIndex);
  void clear() noexcept;
  /// Of maps that forget, the time at which their cells are read; the stamp of the last scan in any map. The smallest
  /// number before the first.
  std::int64_t now_ns = std::numeric_limits<std::int64_t>::min();
  /// In row-major order of tiles.
  [[nodiscard]] const std::map<TileIndex, Tile>& tiles() const noexcept { return tiles_; }

  /// Where cell (x, y) of a tile, 0 … 63 each, has its first plane; the planes follow 16 floats apart.
  [[nodiscard]] std::size_t cell_offset(int x, int y) const noexcept {
    const int micro = (y >> 2) * kernels::kMicrosPerSide + (x >> 2), inside = (y & 3) * 4 + (x & 3);
    return static_cast<std::size_t>(micro) * kernels::kMicroCells * static_cast<std::size_t>(planes_) +
           static_cast<std::size_t>(inside);
  }

 private:
  CellLayout layout_;
  int planes_;
  std::size_t cap_bytes_;
  std::map<TileIndex, Tile> tiles_;  // in order
  TileTable table_;                  // the same, to be found fast
  TileMemory memory_;
};

}  // namespace evigrid
