// SPDX-License-Identifier: Apache-2.0
// What reading needs of a grid: the map as it is, or a view of it. Tiles of 64 × 64 cells; their inside is the kernels'
// layout (kernel_table.hpp), and nothing else of the engine looks into it but `cell_offset`.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "grid/cell_layout.hpp"
#include "grid/tile_index.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid {

inline std::int64_t tile_coordinate(std::int64_t cell) noexcept { return cell >> 6; }
inline TileIndex tile_of(std::int64_t x, std::int64_t y) noexcept { return {tile_coordinate(y), tile_coordinate(x)}; }

struct TileRef {
  TileIndex at;
  const float* cells;
};

class TileSource {
 public:
  explicit TileSource(std::shared_ptr<const CellLayout> layout) : layout_(std::move(layout)) {
    planes_ = static_cast<int>(layout_->planes.size());
  }
  virtual ~TileSource() = default;
  [[nodiscard]] const CellLayout& layout() const noexcept { return *layout_; }
  [[nodiscard]] const std::shared_ptr<const CellLayout>& shared_layout() const noexcept { return layout_; }
  [[nodiscard]] int planes() const noexcept { return planes_; }
  [[nodiscard]] std::size_t tile_bytes() const noexcept {
    return static_cast<std::size_t>(kernels::kTileSide * kernels::kTileSide * planes_) * sizeof(float);
  }
  /// Where cell (x, y) of a tile, 0 … 63 each, has its first plane; the planes follow 16 floats apart.
  [[nodiscard]] std::size_t cell_offset(int x, int y) const noexcept {
    const int micro = (y >> 2) * kernels::kMicrosPerSide + (x >> 2), inside = (y & 3) * 4 + (x & 3);
    return static_cast<std::size_t>(micro) * kernels::kMicroCells * static_cast<std::size_t>(planes_) +
           static_cast<std::size_t>(inside);
  }
  /// Of maps that forget, the time at which their cells are read; the stamp of the last scan in any map. The smallest
  /// number before the first.
  std::int64_t now_ns = std::numeric_limits<std::int64_t>::min();
  /// nullptr where no tile is.
  [[nodiscard]] virtual const float* cells_of(TileIndex) const noexcept = 0;
  [[nodiscard]] virtual std::size_t size() const noexcept = 0;
  /// In row-major order of tiles.
  [[nodiscard]] virtual std::vector<TileRef> in_order() const = 0;

 private:
  std::shared_ptr<const CellLayout> layout_;
  int planes_ = 0;
};

}  // namespace evigrid
