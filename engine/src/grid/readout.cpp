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

constexpr int kSide = kernels::kTileSide, kMicro = kernels::kMicroSide, kCells = kernels::kMicroCells;

/// The masses of four rows of a tile's cells: the unit of reading. Micro-tiles beside each other lie one after the
/// other, so it is one call of the kernel.
struct Strip {
  alignas(64) float masses[kernels::kMicrosPerSide * 4 * kCells];

  void read(const TileStore& store, const Tile& tile, int y) {
    store.layout().read_out(tile.cells.get() + store.cell_offset(0, y & ~3), store.planes(), kernels::kMicrosPerSide,
                            masses);
  }
  [[nodiscard]] Mass at(int x, int y) const noexcept {
    const float* p = masses + (x / kMicro) * 4 * kCells + (y % kMicro) * kMicro + x % kMicro;
    return {p[0], p[kCells], p[2 * kCells], p[3 * kCells]};
  }
};

void add_history(const TileStore& store, const Tile& tile, int x, int y, CellState& out) noexcept {
  const CellLayout& l = store.layout();
  const float* p = tile.cells.get() + store.cell_offset(x, y);
  if (l.conflict >= 0) out.conflict = p[l.conflict * kCells];
  if (l.con >= 0) out.con = p[l.con * kCells];
  if (l.last_conflict >= 0) out.last_conflict = p[l.last_conflict * kCells];
}

bool vacuous(const Mass& m) noexcept { return m == Mass{}; }

/// Four rows at a time into the caller's buffer, one look-up of a tile for a run of cells.
template <class T, class F>
void fill(const TileStore& store, CellRect rect, std::span<T> out, std::ptrdiff_t stride, F&& of) {
  if (rect.empty()) return;
  const auto needed = static_cast<std::size_t>(rect.height - 1) * static_cast<std::size_t>(stride) +
                      static_cast<std::size_t>(rect.width);
  if (stride < rect.width || out.size() < needed)
    throw std::invalid_argument("render: the buffer is smaller than the rectangle");
  Strip strip;
  for (std::int64_t y0 = rect.y; y0 < rect.y + rect.height;) {
    const std::int64_t y1 = std::min((y0 | 3) + 1, rect.y + rect.height);
    for (std::int64_t x0 = rect.x; x0 < rect.x + rect.width;) {
      const std::int64_t x1 = std::min((tile_coordinate(x0) + 1) * kSide, rect.x + rect.width);
      const Tile* tile = store.find(tile_of(x0, y0));
      if (tile != nullptr) strip.read(store, *tile, static_cast<int>(y0 & 63));
      for (std::int64_t y = y0; y < y1; ++y) {
        T* row = out.data() + (y - rect.y) * stride + (x0 - rect.x);
        for (std::int64_t x = x0; x < x1; ++x) {
          CellState cell;
          if (tile != nullptr) {
            const int tx = static_cast<int>(x & 63), ty = static_cast<int>(y & 63);
            cell.mass = strip.at(tx, ty);
            add_history(store, *tile, tx, ty, cell);
          }
          *row++ = of(cell);
        }
      }
      x0 = x1;
    }
    y0 = y1;
  }
}

struct Costs {
  int none, lethal, most;  // no information; occupied; the largest of what lies between (the least is 1)
};

int cost(const Costmap& c, const Mass& m, Costs costs) noexcept {
  const double betp = value_of(Layer::betp, m);
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

std::uint64_t two(float low, float high) noexcept {
  return std::bit_cast<std::uint32_t>(low) | static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(high)) << 32;
}

}  // namespace

CellState read_cell(const TileStore& store, CellIndex c) noexcept {
  const Tile* tile = store.find(tile_of(c.x, c.y));
  if (tile == nullptr) return {};
  const int x = static_cast<int>(c.x & 63), y = static_cast<int>(c.y & 63);
  alignas(64) float m[4 * kCells];
  store.layout().read_out(tile->cells.get() + store.cell_offset(x & ~3, y & ~3), store.planes(), 1, m);
  const float* p = m + (y % kMicro) * kMicro + x % kMicro;
  CellState out{{p[0], p[kCells], p[2 * kCells], p[3 * kCells]}};
  add_history(store, *tile, x, y, out);
  return out;
}

CellRect occupied_bounds(const TileStore& store) {
  constexpr auto kMax = std::numeric_limits<std::int64_t>::max(), kMin = std::numeric_limits<std::int64_t>::min();
  std::int64_t x0 = kMax, x1 = kMin, y0 = kMax, y1 = kMin;
  Strip strip;
  for (const auto& [at, tile] : store.tiles()) {
    for (int y = 0; y < kSide; ++y) {
      if (y % kMicro == 0) strip.read(store, tile, y);
      for (int x = 0; x < kSide; ++x) {
        if (vacuous(strip.at(x, y))) continue;
        x0 = std::min(x0, at.x * kSide + x), x1 = std::max(x1, at.x * kSide + x);
        y0 = std::min(y0, at.y * kSide + y), y1 = std::max(y1, at.y * kSide + y);
      }
    }
  }
  if (x1 < x0) return {};
  return {x0, y0, x1 - x0 + 1, y1 - y0 + 1};
}

void render_layer(const TileStore& store, Layer layer, const ReadOutParams& params, CellRect rect,
                  std::span<float> out, std::ptrdiff_t stride) {
  const auto draw = [&](auto&& of) { fill(store, rect, out, stride, of); };
  switch (layer) {
    case Layer::conflict:
      return draw([](const CellState& c) { return c.conflict; });
    case Layer::con:
      return draw([](const CellState& c) { return c.con; });
    case Layer::last_conflict:
      return draw([](const CellState& c) { return c.last_conflict; });
    default:
      return draw([&](const CellState& c) { return static_cast<float>(value_of(layer, c.mass, params)); });
  }
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
  std::vector<Strip> strips;
  for (auto band = tiles.begin(); band != tiles.end();) {
    auto band_end = band;
    while (band_end != tiles.end() && band_end->first.y == band->first.y) ++band_end;
    strips.resize(static_cast<std::size_t>(std::distance(band, band_end)));
    for (int y = 0; y < kSide; ++y) {
      auto strip = strips.begin();
      for (auto it = band; it != band_end; ++it, ++strip) {
        if (y % kMicro == 0) strip->read(store, it->second, y);
        for (int x = 0; x < kSide; ++x) {
          const Mass m = strip->at(x, y);
          if (vacuous(m)) continue;
          h = mix(h, static_cast<std::uint64_t>(it->first.x * kSide + x));
          h = mix(h, static_cast<std::uint64_t>(it->first.y * kSide + y));
          h = mix(h, two(m.e, m.o));
          h = mix(h, two(m.u, m.c));  // c: 0 unless the rule keeps one
        }
      }
    }
    band = band_end;
  }
  return h;
}

}  // namespace evigrid
