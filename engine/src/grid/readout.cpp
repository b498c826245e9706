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

/// The planes of a micro-tile, 16 cells each; k is null without the plane of conflict.
struct Micro {
  const float *e, *o, *u, *k;
};

/// One layer of a micro-tile.
void layer_of(Layer layer, const Micro& m, float* out) noexcept {
  const auto each = [&](auto&& of) {
    for (int i = 0; i < kernels::kMicroCells; ++i) out[i] = of(i);
  };
  switch (layer) {
    case Layer::betp:
      return each([&](int i) { return m.o[i] + m.u[i] * 0.5f; });
    case Layer::bel:
      return each([&](int i) { return m.o[i]; });
    case Layer::pl:
      return each([&](int i) { return m.o[i] + m.u[i]; });
    case Layer::empty:
      return each([&](int i) { return m.e[i]; });
    case Layer::unknown:
      return each([&](int i) { return m.u[i]; });
    case Layer::conflict:
      return each([&](int i) { return m.k == nullptr ? 0.0f : m.k[i]; });
  }
}

void require_room(CellRect rect, std::size_t size, std::ptrdiff_t stride) {
  const auto needed = static_cast<std::size_t>(rect.height - 1) * static_cast<std::size_t>(stride) +
                      static_cast<std::size_t>(rect.width);
  if (stride < rect.width || size < needed)
    throw std::invalid_argument("render: the buffer is smaller than the rectangle");
}

/// The part of `rect` in one tile, micro-tile by micro-tile: of(micro, out) makes 16 values, straight from the planes
/// so that the compiler sees vectors; those within the rectangle go to their rows. `part` lies in the tile.
template <class T, class F>
void fill_tile(const TileStore& store, const Tile& tile, CellRect part, T* to, std::ptrdiff_t stride, F&& of) {
  constexpr int kMicro = kernels::kMicroSide, kCells = kernels::kMicroCells;
  const int x0 = static_cast<int>(part.x & 63), x1 = x0 + static_cast<int>(part.width);
  const int y0 = static_cast<int>(part.y & 63), y1 = y0 + static_cast<int>(part.height);
  T values[kCells];
  for (int my = y0 & ~3; my < y1; my += kMicro) {
    for (int mx = x0 & ~3; mx < x1; mx += kMicro) {
      const float* p = tile.cells.get() + store.cell_offset(mx, my);
      of(Micro{p, p + kCells, p + 2 * kCells, store.planes() == 4 ? p + 3 * kCells : nullptr}, values);
      const int left = std::max(mx, x0), right = std::min(mx + kMicro, x1);
      for (int y = std::max(my, y0); y < std::min(my + kMicro, y1); ++y)
        std::copy_n(values + (y - my) * kMicro + (left - mx), right - left, to + (y - y0) * stride + (left - x0));
    }
  }
}

/// Tile by tile into the caller's buffer; `never_seen` where there is none.
template <class T, class F>
void fill(const TileStore& store, CellRect rect, std::span<T> out, std::ptrdiff_t stride, T never_seen, F&& of) {
  if (rect.empty()) return;
  require_room(rect, out.size(), stride);
  const std::int64_t x_end = rect.x + rect.width, y_end = rect.y + rect.height;
  for (std::int64_t y = rect.y; y < y_end;) {
    const std::int64_t below = std::min((tile_coordinate(y) + 1) * kSide, y_end);
    for (std::int64_t x = rect.x; x < x_end;) {
      const std::int64_t right = std::min((tile_coordinate(x) + 1) * kSide, x_end);
      T* to = out.data() + (y - rect.y) * stride + (x - rect.x);
      if (const Tile* tile = store.find(tile_of(x, y))) {
        fill_tile(store, *tile, {x, y, right - x, below - y}, to, stride, of);
      } else {
        for (std::int64_t row = 0; row < below - y; ++row) std::fill_n(to + row * stride, right - x, never_seen);
      }
      x = right;
    }
    y = below;
  }
}

/// A Costmap in the form that a cell needs: everything in float.
struct Costs {
  float free_below, lethal_above, max_unknown, slope;
  float none, lethal;  // no information; occupied

  /// most: the largest cost of what is neither free nor occupied; the least is 1.
  Costs(const Costmap& c, int none_cost, int lethal_cost, int most)
      : free_below(static_cast<float>(c.free_below)),
        lethal_above(static_cast<float>(c.lethal_above)),
        max_unknown(static_cast<float>(c.max_unknown)),
        slope(c.free_below < c.lethal_above ? static_cast<float>((most - 1) / (c.lethal_above - c.free_below)) : 0),
        none(static_cast<float>(none_cost)),
        lethal(static_cast<float>(lethal_cost)) {}

  /// Selections: with -fno-trapping-math (engine/CMakeLists.txt) the loop over a micro-tile becomes vectors.
  [[nodiscard]] int of(float o, float u) const noexcept {
    const float betp = o + 0.5f * u;
    const float between = (betp - free_below) * slope + 1.5f;  // 1 + the nearest whole number, once it is cut
    const float cost = betp > lethal_above ? lethal : betp < free_below ? 0.0f : between;
    return static_cast<int>(u > max_unknown ? none : cost);
  }
};

Costs occupancy(const Costmap& c) { return {c, -1, 100, 99}; }
Costs costs(const Costmap& c) { return {c, 255, 254, 252}; }

void require_ordered(const Costmap& c) {
  if (!(c.free_below >= 0 && c.free_below < c.lethal_above && c.lethal_above <= 1))
    throw std::invalid_argument("costmap: free_below and lethal_above must be 0 <= free_below < lethal_above <= 1");
}

template <class T>
void render_costs(const TileStore& store, const Costs& c, CellRect rect, std::span<T> out, std::ptrdiff_t stride) {
  fill(store, rect, out, stride, static_cast<T>(c.of(0, 1)), [&c](const Micro& m, T* to) {
    int cost[kernels::kMicroCells];  // apart from `to`, which as bytes might be anything: then the loop becomes vectors
    for (int i = 0; i < kernels::kMicroCells; ++i) cost[i] = c.of(m.o[i], m.u[i]);
    std::copy_n(cost, kernels::kMicroCells, to);
  });
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
  constexpr float kVacuous[kernels::kMicroCells] = {}, kUnknown[kernels::kMicroCells] = {1};
  float never_seen[kernels::kMicroCells];
  layer_of(layer, {kVacuous, kVacuous, kUnknown, kVacuous}, never_seen);
  fill(store, rect, out, stride, never_seen[0], [layer](const Micro& m, float* to) { layer_of(layer, m, to); });
}

std::int8_t occupancy_of(const Costmap& c, const Mass& m) noexcept {
  return static_cast<std::int8_t>(occupancy(c).of(m.o, m.u));
}
std::uint8_t cost_of(const Costmap& c, const Mass& m) noexcept {
  return static_cast<std::uint8_t>(costs(c).of(m.o, m.u));
}

void render_costmap(const TileStore& store, const Costmap& c, CellRect rect, std::span<std::int8_t> out,
                    std::ptrdiff_t stride) {
  require_ordered(c);
  render_costs(store, occupancy(c), rect, out, stride);
}
void render_costmap(const TileStore& store, const Costmap& c, CellRect rect, std::span<std::uint8_t> out,
                    std::ptrdiff_t stride) {
  require_ordered(c);
  render_costs(store, costs(c), rect, out, stride);
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
