// SPDX-License-Identifier: Apache-2.0
// The writer's side of the sparse grid: tiles of 64 × 64 cells, made when a reading first reaches them, copied when a
// view still reads what is to be written or when they were paged out, and given back when they are dropped.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
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
  std::uint64_t batch = 0;  // the last operation that reached it, and its place among the tiles of a batch of scans
  std::uint32_t place = 0;
  bool fresh = true;                        // made since, never changed
  Tile *newer = nullptr, *older = nullptr;  // change_log.hpp: chain by the last change
  float* on_device = nullptr;               // device/device_map.hpp: its cells there, those of that version
  std::uint64_t device_version = kNoVersion;
  bool away = false;  // and nowhere else: `cells` are older
};

class TileStore final : public TileSource {
 public:
  TileStore(CellLayout layout, std::size_t cap_bytes);
  ~TileStore() override;
  [[nodiscard]] std::size_t size() const noexcept override { return tiles_.size(); }
  [[nodiscard]] std::size_t bytes() const { return ages_->count().resident * tile_bytes(); }  ///< and what views hold
  [[nodiscard]] std::size_t paged_bytes() const { return ages_->count().paged * tile_bytes(); }
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

  /// From now on tiles may be paged to a file in that directory when the cap is reached. Throws std::system_error.
  void page_to(const std::filesystem::path& directory);
  [[nodiscard]] bool pages() const noexcept { return pages_; }
  /// Something is about to write to tiles. Those that it reaches (pin, own, get_or_make) are not paged out before the
  /// next operation begins.
  std::uint64_t begin_operation() noexcept { return ++operation_; }
  void pin(Tile& tile) const noexcept { tile.batch = operation_; }
  /// Throws std::length_error when `more` further tiles would not fit under the cap, and std::system_error when others
  /// would have to go to a page file that cannot be written.
  void reserve(std::size_t more);
  Tile& get_or_make(TileIndex);
  void set_vacuous(Tile&) noexcept;
  [[nodiscard]] bool is_vacuous(const Tile&) const noexcept;
  void erase(TileIndex) noexcept;
  void clear() noexcept;

  /// Whether a view may be reading the tile, or it was paged out: then it must not be written before it has been given
  /// another buffer.
  [[nodiscard]] bool seen(const Tile& tile) const noexcept {
    return ages_->seen(tile.buffer->born) || tile.buffer->room.paged;
  }
  [[nodiscard]] bool any_seen() const { return ages_->any_view() || (pages_ && ages_->count().paged > 0); }
  /// A buffer for a copy of a tile; cells not set. Throws std::bad_alloc.
  [[nodiscard]] TileBuffer* make_buffer() { return ages_->make(); }
  void drop_buffer(TileBuffer* buffer) noexcept { ages_->retire(buffer); }
  /// The tile goes on in `copy`, which holds the same cells; the views keep the old buffer.
  void replace(Tile&, TileBuffer* copy) noexcept;
  /// Copies the tile where it must be: for writers of single tiles. Throws std::length_error, std::bad_alloc.
  void own(Tile&);

  [[nodiscard]] const std::shared_ptr<TileAges>& ages() const noexcept { return ages_; }
  /// Tiles that were made, given another buffer or erased since this list was cleared last, as long as it is watched.
  std::vector<TileIndex>& moved() noexcept { return moved_; }
  [[nodiscard]] bool watched() const noexcept { return watched_; }
  void watch(bool on) noexcept { watched_ = on, moved_.clear(); }

 private:
  void note(TileIndex at) noexcept;
  void page_out(std::size_t least);
  std::size_t cap_bytes_;
  std::uint64_t operation_ = 0;
  bool pages_ = false;
  std::map<TileIndex, Tile> tiles_;  // in order
  TileTable table_;                  // the same, to be found fast
  std::shared_ptr<TileAges> ages_;   // lives as long as the last view
  std::vector<TileIndex> moved_;
  bool watched_ = false;
};

}  // namespace evigrid
