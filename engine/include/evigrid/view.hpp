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

#include "evigrid/map.hpp"

namespace evigrid {

class ViewState;

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
