// SPDX-License-Identifier: Apache-2.0
#include "grid/readout.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "grid/fill_rows.hpp"
#include "grid/rect.hpp"

namespace evigrid {
namespace {

using namespace rows;

void add_history(const TileSource& store, const float* cells, int x, int y, CellState& out) noexcept {
  const CellLayout& l = store.layout();
  const float* p = cells + store.cell_offset(x, y);
  if (l.conflict >= 0) out.conflict = p[l.conflict * kCells];
  if (l.con >= 0) out.con = p[l.con * kCells];
  if (l.last_conflict >= 0) out.last_conflict = p[l.last_conflict * kCells];
}

bool vacuous(const Mass& m) noexcept { return m == Mass{}; }

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
  constexpr auto kMost = static_cast<double>(2 * kFarthestCell);  // a map may have cells at kFarthestCell itself
  const auto index = [&](double v) {  // fmax: NaN gives the other
    return static_cast<std::int64_t>(std::floor(std::fmin(std::fmax(v / cell_m, -kMost), kMost)));
  };
  return {index(x_m), index(y_m)};
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
  fill(store, rect, out, stride, never_seen[0], [&](const float* cells, const CellRect& part, float* to) {
    fill_tile(store, cells, part, to, stride,
              [&](const Micro& m, float* values) { layer_of(layer, params, m, values); });
  });
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
