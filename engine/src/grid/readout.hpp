// SPDX-License-Identifier: Apache-2.0
// Reading the map: single cells, layers, bounds, hash. Never writes.
#pragma once
#include <cstdint>
#include <span>

#include "evigrid/map.hpp"
#include "grid/tile_costs.hpp"
#include "grid/tile_source.hpp"

namespace evigrid {

CellIndex cell_of(double x_m, double y_m, double cell_m) noexcept;

struct CellState {
  Mass mass;
  float conflict = 0, con = 0, last_conflict = 0;
};
CellState read_cell(const TileSource&, CellIndex) noexcept;
CellRect occupied_bounds(const TileSource&);
void render_layer(const TileSource&, Layer, const ReadOutParams&, CellRect, std::span<float> out,
                  std::ptrdiff_t stride);
/// Of occupancy_of and cost_of. Throw std::invalid_argument when not 0 ≤ free_below < lethal_above ≤ 1.
kernels::CostArgs occupancy_args(const Costmap&);
kernels::CostArgs cost_args(const Costmap&);
/// `known`: costs of tiles, by the same arguments, whose cells are not to be read.
void render_costmap(const TileSource&, const kernels::CostArgs&, CellRect, std::span<std::int8_t> out,
                    std::ptrdiff_t stride, const TileCosts* known = nullptr);
void render_costmap(const TileSource&, const kernels::CostArgs&, CellRect, std::span<std::uint8_t> out,
                    std::ptrdiff_t stride, const TileCosts* known = nullptr);
std::uint64_t hash_cells(const TileSource&);

}  // namespace evigrid
