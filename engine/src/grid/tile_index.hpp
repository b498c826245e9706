// SPDX-License-Identifier: Apache-2.0
// From a tile's coordinates to the tile: open addressing over squares of 4 × 4 tiles, so that the tiles about one robot
// are found in a few neighbouring lines of memory however large the map is.
#pragma once
#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace evigrid {

/// y first: the order of tiles is row-major.
struct TileIndex {
  std::int64_t y = 0, x = 0;
  friend auto operator<=>(const TileIndex&, const TileIndex&) = default;
};

struct Tile;

class TileTable {
 public:
  [[nodiscard]] Tile* find(TileIndex at) const noexcept {
    if (squares_.empty()) return nullptr;
    const TileIndex square{at.y >> 2, at.x >> 2};
    for (std::size_t i = hash(square) & mask_;; i = (i + 1) & mask_) {
      const Square& s = squares_[i];
      if (!s.used) return nullptr;
      if (s.at == square) return s.tiles[place(at)];
    }
  }
  void insert(TileIndex at, Tile* tile) {
    if (2 * (used_ + 1) > squares_.size()) grow();
    Square& s = square_of({at.y >> 2, at.x >> 2});
    s.tiles[place(at)] = tile;
  }
  void erase(TileIndex at) noexcept {
    if (squares_.empty()) return;
    const TileIndex square{at.y >> 2, at.x >> 2};
    for (std::size_t i = hash(square) & mask_; squares_[i].used; i = (i + 1) & mask_) {
      if (squares_[i].at == square)
        squares_[i].tiles[place(at)] = nullptr;  // an empty square goes when the table grows
    }
  }
  void clear() noexcept {
    squares_.clear();
    used_ = mask_ = 0;
  }

 private:
  struct alignas(64) Square {
    TileIndex at;
    bool used = false;
    std::array<Tile*, 16> tiles{};
  };
  static std::size_t place(TileIndex at) noexcept { return static_cast<std::size_t>((at.y & 3) * 4 + (at.x & 3)); }
  static std::size_t hash(TileIndex s) noexcept {
    std::uint64_t h = static_cast<std::uint64_t>(s.y) * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(s.x);
    h = (h ^ (h >> 32)) * 0xd6e8feb86659fd93u;
    return static_cast<std::size_t>(h ^ (h >> 32));
  }
  Square& square_of(TileIndex square) {
    std::size_t i = hash(square) & mask_;
    while (squares_[i].used && squares_[i].at != square) i = (i + 1) & mask_;
    if (!squares_[i].used) {
      squares_[i].used = true;
      squares_[i].at = square;
      ++used_;
    }
    return squares_[i];
  }
  /// Room for twice what is left: a window that moves on leaves empty squares behind.
  void grow() {
    const auto kept = [](const Square& s) {
      return std::any_of(s.tiles.begin(), s.tiles.end(), [](const Tile* t) { return t != nullptr; });
    };
    std::size_t size = 16;
    while (size < 4 * (static_cast<std::size_t>(std::count_if(squares_.begin(), squares_.end(), kept)) + 1)) size *= 2;
    std::vector<Square> old(size);
    old.swap(squares_);
    mask_ = squares_.size() - 1;
    used_ = 0;
    for (const Square& s : old) {
      if (kept(s)) square_of(s.at).tiles = s.tiles;
    }
  }
  std::vector<Square> squares_;
  std::size_t used_ = 0, mask_ = 0;
};

}  // namespace evigrid
