// SPDX-License-Identifier: Apache-2.0
// Where readings may write: within the window, not in protected areas, and only on some tiles when the past is fused
// anew. Asked once a tile and batch.
#pragma once
#include <algorithm>
#include <optional>
#include <unordered_set>
#include <vector>

#include "evigrid/types.hpp"
#include "grid/rect.hpp"
#include "grid/tile_source.hpp"

namespace evigrid {

/// Tiles from first to last, inclusive.
struct TileRect {
  TileIndex first, last;
  [[nodiscard]] bool holds(TileIndex t) const noexcept {
    return t.x >= first.x && t.x <= last.x && t.y >= first.y && t.y <= last.y;
  }
  [[nodiscard]] double tiles() const noexcept {
    return static_cast<double>(last.x - first.x + 1) * static_cast<double>(last.y - first.y + 1);
  }
};
/// All tiles that a rectangle of cells meets; it is not empty.
inline TileRect tiles_of(const CellRect& r) noexcept {
  return {tile_of(r.x, r.y), tile_of(r.x + r.width - 1, r.y + r.height - 1)};
}
/// Its cells, as far as callers may ask (grid/rect.hpp).
inline CellRect cells_of(const TileRect& r) noexcept {
  constexpr std::int64_t kSide = kernels::kTileSide;
  const auto length = [](std::int64_t first, std::int64_t last) {
    return std::min((last - first + 1) * kSide, 2 * kFarthestCell);
  };
  return {r.first.x * kSide, r.first.y * kSide, length(r.first.x, r.last.x), length(r.first.y, r.last.y)};
}
/// The part of a rectangle that lies in a tile, in cells 0 … 63 of it.
inline CellRect part_in(const CellRect& r, TileIndex at) noexcept {
  constexpr std::int64_t kSide = kernels::kTileSide;
  const std::int64_t x0 = std::max(r.x - at.x * kSide, std::int64_t{0}),
                     y0 = std::max(r.y - at.y * kSide, std::int64_t{0}),
                     x1 = std::min(r.x + r.width - at.x * kSide, kSide),
                     y1 = std::min(r.y + r.height - at.y * kSide, kSide);
  return {x0, y0, std::max(x1 - x0, std::int64_t{0}), std::max(y1 - y0, std::int64_t{0})};
}
inline bool is_whole(const CellRect& part) noexcept {
  return part.width == kernels::kTileSide && part.height == kernels::kTileSide;
}

struct TileIndexHash {
  std::size_t operator()(TileIndex t) const noexcept {
    const auto h = static_cast<std::uint64_t>(t.y) * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(t.x);
    return static_cast<std::size_t>((h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u);
  }
};
using TileSet = std::unordered_set<TileIndex, TileIndexHash>;

struct Admission {
  std::optional<TileRect> window;
  std::vector<CellRect> guarded;  // protected areas
  const TileSet* only = nullptr;

  [[nodiscard]] bool restricts() const noexcept { return window || !guarded.empty() || only != nullptr; }
  /// Whether no cell of the tile may change.
  [[nodiscard]] bool refuses(TileIndex at) const noexcept {
    return (window && !window->holds(at)) || (only != nullptr && !only->contains(at)) ||
           std::any_of(guarded.begin(), guarded.end(), [&](const CellRect& r) { return is_whole(part_in(r, at)); });
  }
};

}  // namespace evigrid
