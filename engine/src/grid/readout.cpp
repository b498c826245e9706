// SPDX-License-Identifier: Apache-2.0
#include "grid/readout.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace evigrid {
namespace {

constexpr int kSide = kernels::kTileSide;

CellState state_at(const TileStore& store, const Tile& tile, int x, int y) noexcept {
  const float* p = tile.cells.get() + store.cell_offset(x, y);
  return {{p[0], p[kernels::kMicroCells], p[2 * kernels::kMicroCells]},
          store.planes() == 4 ? p[3 * kernels::kMicroCells] : 0.0f};
}

bool vacuous(const Mass& m) noexcept { return m == Mass{}; }

float value(Layer layer, const CellState& c) noexcept {
  switch (layer) {
    case Layer::betp:
      return c.mass.o + c.mass.u * 0.5f;
    case Layer::bel:
      return c.mass.o;
    case Layer::pl:
      return c.mass.o + c.mass.u;
    case Layer::empty:
      return c.mass.e;
    case Layer::unknown:
      return c.mass.u;
    case Layer::conflict:
      return c.conflict;
  }
  return 0;
}

/// Row by row into the caller's buffer, one look-up of a tile for a run of cells.
template <class T, class F>
void fill(const TileStore& store, CellRect rect, std::span<T> out, std::ptrdiff_t stride, F&& of) {
  if (rect.empty()) return;
  const auto needed = static_cast<std::size_t>(rect.height - 1) * static_cast<std::size_t>(stride) +
                      static_cast<std::size_t>(rect.width);
  if (stride < rect.width || out.size() < needed)
    throw std::invalid_argument("render: the buffer is smaller than the rectangle");
  for (std::int64_t y = rect.y; y < rect.y + rect.height; ++y) {
    T* row = out.data() + (y - rect.y) * stride;
    for (std::int64_t x = rect.x; x < rect.x + rect.width;) {
      const std::int64_t end = std::min((tile_coordinate(x) + 1) * kSide, rect.x + rect.width);
      const Tile* tile = store.find(tile_of(x, y));
      for (; x < end; ++x) {
        *row++ = of(tile == nullptr ? CellState{}
                                    : state_at(store, *tile, static_cast<int>(x & 63), static_cast<int>(y & 63)));
      }
    }
  }
}

struct Costs {
  int none, lethal, most;  // no information; occupied; the largest of what lies between (the least is 1)
};

int cost(const Costmap& c, const Mass& m, Costs costs) noexcept {
  const double betp = m.o + 0.5 * m.u;
  if (m.u > c.max_unknown) return costs.none;
  if (betp > c.lethal_above) return costs.lethal;
  if (betp < c.free_below) return 0;
  const double part = (betp - c.free_below) / (c.lethal_above - c.free_below);
  return static_cast<int>(1 + std::lround(part * (costs.most - 1)));
}

void require_ordered(const Costmap& c) {
  if (!(c.free_below >= 0 && c.free_below < c.lethal_above && c.lethal_above <= 1))
    throw std::invalid_argument("costmap: free_below and lethal_above must be 0 <= free_below < lethal_above <= 1");
}

/// A 64-bit mix per word (constants of splitmix64): enough for "are these maps the same bits?".
std::uint64_t mix(std::uint64_t h, std::uint64_t word) noexcept {
  h = (h ^ word) * 0x9E3779B97F4A7C15ull;
  h ^= h >> 32;
  h *= 0xBF58476D1CE4E5B9ull;
  return h ^ (h >> 29);
}

}  // namespace

CellState read_cell(const TileStore& store, CellIndex c) noexcept {
  const Tile* tile = store.find(tile_of(c.x, c.y));
  return tile == nullptr ? CellState{} : state_at(store, *tile, static_cast<int>(c.x & 63), static_cast<int>(c.y & 63));
}

CellRect occupied_bounds(const TileStore& store) {
  constexpr auto kMax = std::numeric_limits<std::int64_t>::max(), kMin = std::numeric_limits<std::int64_t>::min();
  std::int64_t x0 = kMax, x1 = kMin, y0 = kMax, y1 = kMin;
  for (const auto& [at, tile] : store.tiles()) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        if (vacuous(state_at(store, tile, x, y).mass)) continue;
        x0 = std::min(x0, at.x * kSide + x), x1 = std::max(x1, at.x * kSide + x);
        y0 = std::min(y0, at.y * kSide + y), y1 = std::max(y1, at.y * kSide + y);
      }
    }
  }
  if (x1 < x0) return {};
  return {x0, y0, x1 - x0 + 1, y1 - y0 + 1};
}

void render_layer(const TileStore& store, Layer layer, CellRect rect, std::span<float> out, std::ptrdiff_t stride) {
  fill(store, rect, out, stride, [layer](const CellState& c) { return value(layer, c); });
}

std::int8_t occupancy_of(const Costmap& c, const Mass& m) noexcept {
  return static_cast<std::int8_t>(cost(c, m, {-1, 100, 99}));
}
std::uint8_t cost_of(const Costmap& c, const Mass& m) noexcept {
  return static_cast<std::uint8_t>(cost(c, m, {255, 254, 252}));
}

void render_costmap(const TileStore& store, const Costmap& c, CellRect rect, std::span<std::int8_t> out,
                    std::ptrdiff_t stride) {
  require_ordered(c);
  fill(store, rect, out, stride, [&c](const CellState& cell) { return occupancy_of(c, cell.mass); });
}
void render_costmap(const TileStore& store, const Costmap& c, CellRect rect, std::span<std::uint8_t> out,
                    std::ptrdiff_t stride) {
  require_ordered(c);
  fill(store, rect, out, stride, [&c](const CellState& cell) { return cost_of(c, cell.mass); });
}

std::uint64_t hash_cells(const TileStore& store) {
  std::uint64_t h = 0x45564947524944ull;  // "EVIGRID"
  const auto& tiles = store.tiles();
  for (auto band = tiles.begin(); band != tiles.end();) {
    auto band_end = band;
    while (band_end != tiles.end() && band_end->first.y == band->first.y) ++band_end;
    for (int y = 0; y < kSide; ++y) {
      for (auto it = band; it != band_end; ++it) {
        for (int x = 0; x < kSide; ++x) {
          const Mass m = state_at(store, it->second, x, y).mass;
          if (vacuous(m)) continue;
          h = mix(h, static_cast<std::uint64_t>(it->first.x * kSide + x));
          h = mix(h, static_cast<std::uint64_t>(it->first.y * kSide + y));
          h = mix(h, std::bit_cast<std::uint32_t>(m.e) | static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(m.o))
                                                             << 32);
          h = mix(h, std::bit_cast<std::uint32_t>(m.u));
        }
      }
    }
    band = band_end;
  }
  return h;
}

}  // namespace evigrid
