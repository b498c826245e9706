// SPDX-License-Identifier: Apache-2.0
// The writer's side of the sparse grid: tiles of 64 × 64 cells, made when a reading first reaches them, copied when a
// view still reads what is to be written, and given back when they are dropped.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>

#include "grid/tile_ages.hpp"
#include "grid/tile_source.hpp"

namespace evigrid {

/// Offset of the first cell centre of tile coordinate `t` from an apex at cell i0 plus f.
inline double offset(std::int64_t t, std::int64_t i0, float f) noexcept {
  return static_cast<double>(t * kernels::kTileSide - i0) - static_cast<double>(f);
}

inline constexpr std::uint64_t kNoVersion = ~std::uint64_t{0};

struct Tile {
  TileIndex index;
  float* cells = nullptr;  // of the buffer
  TileBuffer* buffer = nullptr;
  std::uint64_t batch = 0;  // the last batch of scans that reached it, and its place among that batch's tiles
  std::uint32_t place = 0;
  bool fresh = true;                        // made since, never changed
  Tile *newer = nullptr, *older = nullptr;  // change_log.hpp: chain by the last change
  float* on_device = nullptr;               // device/device_map.hpp: its cells there, those of that version
  std::uint64_t device_version = kNoVersion;
};

class TileStore final : public TileSource {
 public:
  TileStore(CellLayout layout, std::size_t cap_bytes);
  ~TileStore() override;
  [[nodiscard]] std::size_t size() const noexcept override { return tiles_.size(); }
  [[nodiscard]] std::size_t bytes() const { return ages_->in_use() * tile_bytes(); }  ///< with what only views see
  [[nodiscard]] const float* cells_of(TileIndex at) const noexcept override {
    const Tile* tile = table_.find(at);
    return tile == nullptr ? nullptr : tile->cells;
  }
  [[nodiscard]] std::vector<TileRef> in_order() const override;
  [[nodiscard]] Tile* find(TileIndex at) noexcept { return table_.find(at); }
  [[nodiscard]] const Tile* find(TileIndex at) const noexcept { return table_.find(at); }
  /// In row-major order of tiles.
  [[nodiscard]] const std::map<TileIndex, Tile>& tiles() const noexcept { return tiles_; }
  [[nodiscard]] std::map<TileIndex, Tile>& tiles() noexcept { return tiles_; }

  /// Throws std::length_error when `more` further tiles would not fit under the cap.
  void reserve(std::size_t more) const;
  Tile& get_or_make(TileIndex);
  void set_vacuous(Tile&) noexcept;
  [[nodiscard]] bool is_vacuous(const Tile&) const noexcept;
  void erase(TileIndex) noexcept;
  void clear() noexcept;

  /// Whether a view may be reading the tile: then it must not be written before it has been given another buffer.
  [[nodiscard]] bool seen(const Tile& tile) const noexcept { return ages_->seen(tile.buffer->born); }
  /// A buffer for a copy of a tile; cells not set. Throws std::bad_alloc.
  [[nodiscard]] TileBuffer* make_buffer() { return ages_->make(); }
  void drop_buffer(TileBuffer* buffer) noexcept { ages_->retire(buffer); }
  /// The tile goes on in `copy`, which holds the same cells; the views keep the old buffer.
  void replace(Tile&, TileBuffer* copy) noexcept;
  /// Copies the tile where a view sees it: for writers of single tiles. Throws std::length_error, std::bad_alloc.
  void own(Tile&);

  [[nodiscard]] const std::shared_ptr<TileAges>& ages() const noexcept { return ages_; }
  /// Tiles that were made, given another buffer or erased since this list was cleared last, as long as it is watched.
  std::vector<TileIndex>& moved() noexcept { return moved_; }
  [[nodiscard]] bool watched() const noexcept { return watched_; }
  void watch(bool on) noexcept { watched_ = on, moved_.clear(); }

 private:
  void note(TileIndex at) noexcept;
  std::size_t cap_bytes_;
  std::map<TileIndex, Tile> tiles_;  // in order
  TileTable table_;                  // the same, to be found fast
  std::shared_ptr<TileAges> ages_;   // lives as long as the last view
  std::vector<TileIndex> moved_;
  bool watched_ = false;
};

}  // namespace evigrid
