// SPDX-License-Identifier: Apache-2.0
// Reading while the map is being written. A view is one version of a map: immutable, cheap to copy, read by any number
// of threads without a lock while the writer goes on, and alive as long as someone holds it, also after its map. Tiles
// are shared with the map until the writer first touches them; then the writer works on a copy. The memory of such
// tiles comes back with the last view that sees them.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "evigrid/export.hpp"
#include "evigrid/map.hpp"

namespace EVIGRID_API evigrid {

class EVIGRID_LOCAL ViewState;

/// A tile of a view where it lies in memory, for consumers that read cells without a copy. Blocks of 4 × 4 cells, each
/// with its planes one after the other, 16 floats a plane; blocks row by row from the smallest y. As an array with
/// strides that is planes × 16 × 4 × 16 × 4: plane, block row, row, block column, column.
struct TilePlanes {
  static constexpr std::int64_t kSide = 64, kBlock = 4, kBlockCells = kBlock * kBlock;
  CellRect rect{};              ///< 64 × 64 cells of the map
  const float* data = nullptr;  ///< lives as long as a copy of the view
  int planes = 0;

  /// Where the cell x, y (0 … 63 from the corner of rect) has its value of a plane.
  [[nodiscard]] const float& at(int plane, std::int64_t x, std::int64_t y) const noexcept {
    const std::int64_t block = y / kBlock * (kSide / kBlock) + x / kBlock;
    return data[(block * planes + plane) * kBlockCells + y % kBlock * kBlock + x % kBlock];
  }
};

class MapView {
 public:
  // As Map's, of the version that the view was made at.
  [[nodiscard]] Mass mass(CellIndex) const noexcept;
  [[nodiscard]] float conflict(CellIndex) const noexcept;
  [[nodiscard]] float con(CellIndex) const noexcept;
  [[nodiscard]] float last_conflict(CellIndex) const noexcept;
  [[nodiscard]] CellIndex cell_at(double x_m, double y_m) const noexcept;
  [[nodiscard]] CellRect bounds() const;
  void render(Layer, CellRect rect, std::span<float> out, std::ptrdiff_t stride, const ReadOutParams& = {}) const;
  void render(const Costmap&, CellRect rect, std::span<std::int8_t> out, std::ptrdiff_t stride) const;
  void render(const Costmap&, CellRect rect, std::span<std::uint8_t> out, std::ptrdiff_t stride) const;
  [[nodiscard]] std::uint64_t hash() const;
  [[nodiscard]] const MapParams& params() const noexcept;
  [[nodiscard]] std::span<const Sensor> sensors() const noexcept;
  [[nodiscard]] std::size_t tiles() const noexcept;

  /// What each cell keeps: the state of the rule ("e", "o", "u" for those whose cells are masses), then the history.
  [[nodiscard]] std::vector<std::string_view> plane_names() const;
  /// All tiles, in row-major order. In maps that forget, cells are here as they were when they were last told
  /// something; mass() and render() read them as they are now.
  [[nodiscard]] std::vector<TilePlanes> tile_planes() const;

  /// Of the map when the view was made.
  [[nodiscard]] std::uint64_t version() const noexcept;
  /// What changed after that version and up to this view's: what to render again. As Map::changes.
  [[nodiscard]] Changes changes(std::uint64_t since) const;

 private:
  friend class Map;
  friend struct MapAccess;
  explicit MapView(std::shared_ptr<const ViewState> state) : state_(std::move(state)) {}
  std::shared_ptr<const ViewState> state_;
};

/// The newest view, handed from the writer to its readers: a copy of a pointer under a lock. As long as it holds a
/// view, each tile is copied once between two calls of set().
class LatestView {
 public:
  void set(MapView view) {
    std::optional<MapView> old(std::move(view));
    const std::lock_guard lock(mutex_);
    view_.swap(old);
  }
  /// nullopt before the first.
  [[nodiscard]] std::optional<MapView> get() const {
    const std::lock_guard lock(mutex_);
    return view_;
  }
  void reset() {
    std::optional<MapView> old;
    const std::lock_guard lock(mutex_);
    view_.swap(old);
  }

 private:
  mutable std::mutex mutex_;
  std::optional<MapView> view_;
};

}  // namespace evigrid
