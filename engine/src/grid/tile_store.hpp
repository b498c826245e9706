// SPDX-License-Identifier: Apache-2.0
// The sparse grid: tiles of 64 × 64 cells, made when a reading first reaches them. Their inside is the kernels' layout
// (kernel_table.hpp); nothing else of the engine looks into it but `cell_offset`.
#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>

#include "kernels/row/kernel_table.hpp"

namespace evigrid {

/// y first: the order of tiles is row-major.
struct TileIndex {
  std::int64_t y = 0, x = 0;
  friend auto operator<=>(const TileIndex&, const TileIndex&) = default;
};

inline std::int64_t tile_coordinate(std::int64_t cell) noexcept { return cell >> 6; }
inline TileIndex tile_of(std::int64_t x, std::int64_t y) noexcept { return {tile_coordinate(y), tile_coordinate(x)}; }
/// Offset of the first cell centre of tile coordinate `t` from an apex at cell i0 plus f.
inline double offset(std::int64_t t, std::int64_t i0, float f) noexcept {
  return static_cast<double>(t * kernels::kTileSide - i0) - static_cast<double>(f);
}

struct TileChange;

struct FreeAligned {
  void operator()(float*) const noexcept;
};

struct Tile {
  TileIndex index;
  std::unique_ptr<float[], FreeAligned> cells;
  TileChange* change = nullptr;  // change_log.hpp
};

class TileStore {
 public:
  TileStore(bool conflict_plane, std::size_t cap_bytes);
  [[nodiscard]] int planes() const noexcept { return planes_; }
  [[nodiscard]] std::size_t tile_bytes() const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return tiles_.size(); }
  [[nodiscard]] std::size_t bytes() const noexcept { return size() * tile_bytes(); }
  [[nodiscard]] const Tile* find(TileIndex) const noexcept;
  /// Throws std::length_error when `more` further tiles would not fit under the cap.
  void reserve(std::size_t more) const;
  Tile& get_or_make(TileIndex);
  void clear() noexcept { tiles_.clear(); }
  /// In row-major order of tiles.
  [[nodiscard]] const std::map<TileIndex, Tile>& tiles() const noexcept { return tiles_; }

  /// Where cell (x, y) of a tile, 0 … 63 each, has its first plane; the planes follow 16 floats apart.
  [[nodiscard]] std::size_t cell_offset(int x, int y) const noexcept {
    const int micro = (y >> 2) * kernels::kMicrosPerSide + (x >> 2), inside = (y & 3) * 4 + (x & 3);
    return static_cast<std::size_t>(micro) * kernels::kMicroCells * static_cast<std::size_t>(planes_) +
           static_cast<std::size_t>(inside);
  }

 private:
  int planes_;
  std::size_t cap_bytes_;
  std::map<TileIndex, Tile> tiles_;
};

}  // namespace evigrid
