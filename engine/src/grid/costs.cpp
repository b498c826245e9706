// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "grid/fill_rows.hpp"
#include "grid/readout.hpp"

namespace evigrid {
namespace {

using namespace rows;

using kernels::CostArgs;

/// most: the largest cost of what is neither free nor occupied; the least is 1.
CostArgs args_of(const Costmap& c, int none, int lethal, int most) {
  const bool ordered = c.free_below < c.lethal_above;
  return {
      static_cast<float>(c.free_below),  static_cast<float>(c.lethal_above),
      static_cast<float>(c.max_unknown), ordered ? static_cast<float>((most - 1) / (c.lethal_above - c.free_below)) : 0,
      static_cast<float>(none),          static_cast<float>(lethal)};
}

/// Of one cell. Selections: with -fno-trapping-math (engine/CMakeLists.txt) a loop over a micro-tile becomes vectors.
int cost(const CostArgs& a, float e, float o, float u, float c) noexcept {
  const float rest = (e + o) + u;  // a cell may hold nothing but c: half of it is on either side then
  const float betp = c > 0 ? (rest > 0 ? (o + 0.5f * u) / rest : 0.5f) : o + 0.5f * u;
  const float between = (betp - a.free_below) * a.slope + 1.5f;  // 1 + the nearest whole number, once it is cut
  const float cost = betp > a.lethal_above ? a.lethal : betp < a.free_below ? 0.0f : between;
  return static_cast<int>(u > a.max_unknown ? a.none : cost);
}

CostArgs occupancy(const Costmap& c) { return args_of(c, -1, 100, 99); }
CostArgs costs(const Costmap& c) { return args_of(c, 255, 254, 252); }

void require_ordered(const Costmap& c) {
  if (!(c.free_below >= 0 && c.free_below < c.lethal_above && c.lethal_above <= 1))
    throw std::invalid_argument("costmap: free_below and lethal_above must be 0 <= free_below < lethal_above <= 1");
}

/// A tile by the table's kernel, four rows at a time: straight to the caller's rows where these are whole.
template <class T>
void closed_tile(const TileSource& store, const CostArgs& a, const float* cells, CellRect part, T* to,
                 std::ptrdiff_t stride) {
  const int x0 = static_cast<int>(part.x & 63), width = static_cast<int>(part.width);
  const int y0 = static_cast<int>(part.y & 63), y1 = y0 + static_cast<int>(part.height);
  const int left = x0 & ~3, micros = (x0 + width - left + kMicro - 1) / kMicro;
  const bool whole_x = left == x0 && width % kMicro == 0;
  const auto render = store.layout().render_costs;
  PresentCells present;
  std::uint8_t rows[kMicro * kSide];
  for (int y = y0 & ~3; y < y1; y += kMicro) {
    const float* const row = present.read(store, cells, left, y, micros);
    if (whole_x && y >= y0 && y + kMicro <= y1) {
      render(a, row, store.planes(), micros, reinterpret_cast<std::uint8_t*>(to + (y - y0) * stride), stride);
      continue;
    }
    render(a, row, store.planes(), micros, rows, kSide);
    for (int r = std::max(y, y0); r < std::min(y + kMicro, y1); ++r)
      std::memcpy(to + (r - y0) * stride, rows + (r - y) * kSide + (x0 - left), static_cast<std::size_t>(width));
  }
}

template <class T>
void render_costs(const TileSource& store, const CostArgs& a, CellRect rect, std::span<T> out, std::ptrdiff_t stride,
                  const TileCosts* known) {
  static_assert(sizeof(T) == 1);
  const T never_seen = static_cast<T>(cost(a, 0, 0, 1, 0));
  fill(store, rect, out, stride, never_seen, [&](const float* cells, const CellRect& part, T* to) {
    if (const std::uint8_t* costs = known == nullptr ? nullptr : known->of(tile_of(part.x, part.y))) {
      costs += (part.y & 63) * kSide + (part.x & 63);
      for (std::int64_t y = 0; y < part.height; ++y)
        std::memcpy(to + y * stride, costs + y * kSide, static_cast<std::size_t>(part.width));
      return;
    }
    if (store.layout().render_costs != nullptr) return closed_tile(store, a, cells, part, to, stride);
    fill_tile(store, cells, part, to, stride, [&](const Micro& m, T* values) {
      int of_cell[kCells];  // apart from the output, which as bytes might be anything
      for (int i = 0; i < kCells; ++i) of_cell[i] = cost(a, m.e[i], m.o[i], m.u[i], m.c[i]);
      std::copy_n(of_cell, kCells, values);
    });
  });
}

}  // namespace

std::int8_t occupancy_of(const Costmap& c, const Mass& m) noexcept {
  return static_cast<std::int8_t>(cost(occupancy(c), m.e, m.o, m.u, m.c));
}
std::uint8_t cost_of(const Costmap& c, const Mass& m) noexcept {
  return static_cast<std::uint8_t>(cost(costs(c), m.e, m.o, m.u, m.c));
}

kernels::CostArgs occupancy_args(const Costmap& c) {
  require_ordered(c);
  return occupancy(c);
}
kernels::CostArgs cost_args(const Costmap& c) {
  require_ordered(c);
  return costs(c);
}

void render_costmap(const TileSource& store, const CostArgs& a, CellRect rect, std::span<std::int8_t> out,
                    std::ptrdiff_t stride, const TileCosts* known) {
  render_costs(store, a, rect, out, stride, known);
}
void render_costmap(const TileSource& store, const CostArgs& a, CellRect rect, std::span<std::uint8_t> out,
                    std::ptrdiff_t stride, const TileCosts* known) {
  render_costs(store, a, rect, out, stride, known);
}

}  // namespace evigrid
