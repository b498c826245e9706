// SPDX-License-Identifier: Apache-2.0
// Reading the map: single cells, layers, bounds, hash. Never writes.
#pragma once
#include <cstdint>
#include <span>

#include "evigrid/map.hpp"
#include "grid/tile_store.hpp"

namespace evigrid {

struct CellState {
  Mass mass;
  float conflict = 0, con = 0, last_conflict = 0;
};
CellState read_cell(const TileStore&, CellIndex) noexcept;
CellRect occupied_bounds(const TileStore&);
void render_layer(const TileStore&, Layer, const ReadOutParams&, CellRect, std::span<float> out, std::ptrdiff_t stride);
void render_costmap(const TileStore&, const Costmap&, CellRect, std::span<std::int8_t> out, std::ptrdiff_t stride);
void render_costmap(const TileStore&, const Costmap&, CellRect, std::span<std::uint8_t> out, std::ptrdiff_t stride);
std::uint64_t hash_cells(const TileStore&);

}  // namespace evigrid
