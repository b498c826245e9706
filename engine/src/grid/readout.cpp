// SPDX-License-Identifier: Apache-2.0
#include "grid/readout.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "grid/decay.hpp"
#include "grid/rect.hpp"

namespace evigrid {
namespace {

constexpr int kSide = kernels::kTileSide, kMicro = kernels::kMicroSide, kCells = kernels::kMicroCells;
constexpr float kZeros[kCells] = {};

/// The planes of micro-tiles beside each other: where they lie or, in maps that forget, a copy as they are now.
class PresentCells {
 public:
  /// `micros` of them from that of cell (x, y) of the tile on. Valid until the next call.
  const float* read(const TileSource& store, const float* tile, int x, int y, int micros) noexcept {
    const float* cells = tile + store.cell_offset(x & ~3, y & ~3);
    if (store.layout().age < 0) return cells;
    std::copy_n(cells, store.cell_offset(kMicro, 0) * static_cast<std::size_t>(micros), copy_);
    age_masses(store.layout(), store.planes(), store.now_ns, copy_, micros);
    return copy_;
  }
  const float* row(const TileSource& store, const float* tile, int y) noexcept {
    return read(store, tile, 0, y, kernels::kMicrosPerSide);
  }

 private:
  alignas(64) float copy_[kernels::kMicrosPerSide * kMostForgettingPlanes * kCells];
};

/// The masses of four rows of a tile's cells: the unit of reading. Micro-tiles beside each other lie one after the
/// other, so it is one call of the kernel.
struct Strip {
  alignas(64) float masses[kernels::kMicrosPerSide * 4 * kCells];
  PresentCells cells;

  void read(const TileSource& store, const float* tile, int y) {
    store.layout().read_out(cells.row(store, tile, y), store.planes(), kernels::kMicrosPerSide, masses);
  }
  [[nodiscard]] Mass at(int x, int y) const noexcept {
    const float* p = masses + (x / kMicro) * 4 * kCells + (y % kMicro) * kMicro + x % kMicro;
    return {p[0], p[kCells], p[2 * kCells], p[3 * kCells]};
  }
};

void add_history(const TileSource& store, const float* cells, int x, int y, CellState& out) noexcept {
  const CellLayout& l = store.layout();
  const float* p = cells + store.cell_offset(x, y);
  if (l.conflict >= 0) out.conflict = p[l.conflict * kCells];
  if (l.con >= 0) out.con = p[l.con * kCells];
  if (l.last_conflict >= 0) out.last_conflict = p[l.last_conflict * kCells];
}

bool vacuous(const Mass& m) noexcept { return m == Mass{}; }

/// A micro-tile as read: its masses, and the history that the map keeps, 16 cells each (zeros where it keeps none).
struct Micro {
  const float *e, *o, *u, *c, *k, *con, *last;
};

/// One layer of a micro-tile.
void layer_of(Layer layer, const ReadOutParams& params, const Micro& m, float* out) noexcept {
  const auto each = [&](auto&& of) {
    for (int i = 0; i < kCells; ++i) out[i] = of(i);
  };
  switch (layer) {
    case Layer::bel:
      return each([&](int i) { return m.o[i]; });
    case Layer::empty:
      return each([&](int i) { return m.e[i]; });
    case Layer::unknown:
      return each([&](int i) { return m.u[i]; });
    case Layer::conflict:
      return each([&](int i) { return m.k[i]; });
    case Layer::con:
      return each([&](int i) { return m.con[i]; });
    case Layer::last_conflict:
      return each([&](int i) { return m.last[i]; });
    case Layer::betp:  // the two that robots ask for ten times a second: vectors where there is no c
    case Layer::pl:
      if (std::all_of(m.c, m.c + kCells, [](float c) { return c == 0; })) {
        const float share = layer == Layer::betp ? 0.5f : 1.0f;
        return each([&](int i) { return m.o[i] + m.u[i] * share; });
      }
      [[fallthrough]];
    default:
      return each([&](int i) { return static_cast<float>(value_of(layer, {m.e[i], m.o[i], m.u[i], m.c[i]}, params)); });
  }
}

/// The part of `rect` in one tile, micro-tile by micro-tile: of(micro, out) makes 16 values, straight from the planes
/// where these are masses so that the compiler sees vectors; those within the rectangle go to their rows. `part` lies
/// in the tile.
template <class T, class F>
void fill_tile(const TileSource& store, const float* cells, CellRect part, T* to, std::ptrdiff_t stride, F&& of) {
  const int x0 = static_cast<int>(part.x & 63), x1 = x0 + static_cast<int>(part.width);
  const int y0 = static_cast<int>(part.y & 63), y1 = y0 + static_cast<int>(part.height);
  const CellLayout& l = store.layout();
  Strip strip;
  T values[kCells];
  for (int my = y0 & ~3; my < y1; my += kMicro) {
    if (!l.planes_are_masses) strip.read(store, cells, my);
    const float* const row = strip.cells.row(store, cells, my);
    for (int mx = x0 & ~3; mx < x1; mx += kMicro) {
      const float* p = row + store.cell_offset(mx, 0);
      const auto kept = [&](int plane) { return plane < 0 ? kZeros : p + plane * kCells; };
      const float* masses = l.planes_are_masses ? p : strip.masses + (mx / kMicro) * 4 * kCells;
      const float* c = l.planes_are_masses ? kept(l.paradox) : masses + 3 * kCells;
      of(Micro{masses, masses + kCells, masses + 2 * kCells, c, kept(l.conflict), kept(l.con), kept(l.last_conflict)},
         values);
      const int left = std::max(mx, x0), right = std::min(mx + kMicro, x1);
      for (int y = std::max(my, y0); y < std::min(my + kMicro, y1); ++y)
        std::copy_n(values + (y - my) * kMicro + (left - mx), right - left, to + (y - y0) * stride + (left - x0));
    }
  }
}

/// Tile by tile into the caller's buffer; `never_seen` where there is none.
template <class T, class F>
void fill(const TileSource& store, CellRect rect, std::span<T> out, std::ptrdiff_t stride, T never_seen, F&& of) {
  if (rect.empty()) return;
  require_room("render", rect, out.size(), stride);
  const std::int64_t x_end = rect.x + rect.width, y_end = rect.y + rect.height;
  for (std::int64_t y = rect.y; y < y_end;) {
    const std::int64_t below = std::min((tile_coordinate(y) + 1) * kSide, y_end);
    for (std::int64_t x = rect.x; x < x_end;) {
      const std::int64_t right = std::min((tile_coordinate(x) + 1) * kSide, x_end);
      T* to = out.data() + (y - rect.y) * stride + (x - rect.x);
      if (const float* cells = store.cells_of(tile_of(x, y))) {
        fill_tile(store, cells, {x, y, right - x, below - y}, to, stride, of);
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
  [[nodiscard]] int of(float e, float o, float u, float c) const noexcept {
    const float betp = (o + 0.5f * u) / (c > 0 ? (e + o) + u : 1.0f);
    const float between = (betp - free_below) * slope + 1.5f;  // 1 + the nearest whole number, once it is cut
    const float cost = betp > lethal_above ? lethal : betp < free_below ? 0.0f : between;
    return static_cast<int>(u > max_unknown ? none : cost);
  }
};

/// The same for a micro-tile without c. A function of its own over plain arrays, so that gcc makes vectors of it.
[[gnu::noinline]] void closed_costs(const Costs& costs, const float* __restrict o, const float* __restrict u,
                                    int* __restrict out) noexcept {
  const Costs c = costs;
  const int none = static_cast<int>(c.none), lethal = static_cast<int>(c.lethal);
  for (int i = 0; i < kCells; ++i) {
    const float betp = o[i] + 0.5f * u[i];
    int cost = static_cast<int>((betp - c.free_below) * c.slope + 1.5f);
    cost = betp < c.free_below ? 0 : cost;
    cost = betp > c.lethal_above ? lethal : cost;
    out[i] = u[i] > c.max_unknown ? none : cost;
  }
}

Costs occupancy(const Costmap& c) { return {c, -1, 100, 99}; }
Costs costs(const Costmap& c) { return {c, 255, 254, 252}; }

void require_ordered(const Costmap& c) {
  if (!(c.free_below >= 0 && c.free_below < c.lethal_above && c.lethal_above <= 1))
    throw std::invalid_argument("costmap: free_below and lethal_above must be 0 <= free_below < lethal_above <= 1");
}

template <class T>
void render_costs(const TileSource& store, const Costs& c, CellRect rect, std::span<T> out, std::ptrdiff_t stride) {
  const T never_seen = static_cast<T>(c.of(0, 0, 1, 0));
  int cost[kCells];  // apart from the output, which as bytes might be anything
  if (store.layout().planes_are_masses && store.layout().paradox < 0) {
    fill(store, rect, out, stride, never_seen, [&](const Micro& m, T* to) {
      closed_costs(c, m.o, m.u, cost);
      std::copy_n(cost, kCells, to);
    });
  } else {
    fill(store, rect, out, stride, never_seen, [&](const Micro& m, T* to) {
      for (int i = 0; i < kCells; ++i) cost[i] = c.of(m.e[i], m.o[i], m.u[i], m.c[i]);
      std::copy_n(cost, kCells, to);
    });
  }
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

CellIndex cell_of(double x_m, double y_m, double cell_m) noexcept {
  return {static_cast<std::int64_t>(std::floor(x_m / cell_m)), static_cast<std::int64_t>(std::floor(y_m / cell_m))};
}

CellState read_cell(const TileSource& store, CellIndex c) noexcept {
  const float* cells = store.cells_of(tile_of(c.x, c.y));
  if (cells == nullptr) return {};
  const int x = static_cast<int>(c.x & 63), y = static_cast<int>(c.y & 63);
  alignas(64) float m[4 * kCells];
  PresentCells present;
  store.layout().read_out(present.read(store, cells, x, y, 1), store.planes(), 1, m);
  const float* p = m + (y % kMicro) * kMicro + x % kMicro;
  CellState out{{p[0], p[kCells], p[2 * kCells], p[3 * kCells]}};
  add_history(store, cells, x, y, out);
  return out;
}

CellRect occupied_bounds(const TileSource& store) {
  constexpr auto kMax = std::numeric_limits<std::int64_t>::max(), kMin = std::numeric_limits<std::int64_t>::min();
  std::int64_t x0 = kMax, x1 = kMin, y0 = kMax, y1 = kMin;
  Strip strip;
  for (const auto& [at, cells] : store.in_order()) {
    for (int y = 0; y < kSide; ++y) {
      if (y % kMicro == 0) strip.read(store, cells, y);
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

void render_layer(const TileSource& store, Layer layer, const ReadOutParams& params, CellRect rect,
                  std::span<float> out, std::ptrdiff_t stride) {
  constexpr float kUnknown[kCells] = {1};
  float never_seen[kCells];
  layer_of(layer, params, {kZeros, kZeros, kUnknown, kZeros, kZeros, kZeros, kZeros}, never_seen);
  fill(store, rect, out, stride, never_seen[0], [&](const Micro& m, float* to) { layer_of(layer, params, m, to); });
}

std::int8_t occupancy_of(const Costmap& c, const Mass& m) noexcept {
  return static_cast<std::int8_t>(occupancy(c).of(m.e, m.o, m.u, m.c));
}
std::uint8_t cost_of(const Costmap& c, const Mass& m) noexcept {
  return static_cast<std::uint8_t>(costs(c).of(m.e, m.o, m.u, m.c));
}

void render_costmap(const TileSource& store, const Costmap& c, CellRect rect, std::span<std::int8_t> out,
                    std::ptrdiff_t stride) {
  require_ordered(c);
  render_costs(store, occupancy(c), rect, out, stride);
}
void render_costmap(const TileSource& store, const Costmap& c, CellRect rect, std::span<std::uint8_t> out,
                    std::ptrdiff_t stride) {
  require_ordered(c);
  render_costs(store, costs(c), rect, out, stride);
}

std::uint64_t hash_cells(const TileSource& store) {
  std::uint64_t h = 0x45564947524944ull;  // "EVIGRID"
  const std::vector<TileRef> tiles = store.in_order();
  std::vector<Strip> strips;
  for (auto band = tiles.begin(); band != tiles.end();) {
    auto band_end = band;
    while (band_end != tiles.end() && band_end->at.y == band->at.y) ++band_end;
    strips.resize(static_cast<std::size_t>(std::distance(band, band_end)));
    for (int y = 0; y < kSide; ++y) {
      auto strip = strips.begin();
      for (auto it = band; it != band_end; ++it, ++strip) {
        if (y % kMicro == 0) strip->read(store, it->cells, y);
        for (int x = 0; x < kSide; ++x) {
          const Mass m = strip->at(x, y);
          if (vacuous(m)) continue;
          h = mix(h, static_cast<std::uint64_t>(it->at.x * kSide + x));
          h = mix(h, static_cast<std::uint64_t>(it->at.y * kSide + y));
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
