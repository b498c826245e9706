// SPDX-License-Identifier: Apache-2.0
// Rasterise, then fill from within: first every cell off the surfaces is solid, then what the fill reaches is free.
// The fill works on whole runs of a row, so its stack holds one entry per run and not one per cell.
#include "evigrid/scenes/truth.hpp"

#include <stdexcept>
#include <string>

#include "truth/outline.hpp"
#include "truth/raster.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::int64_t kMostCells = 1LL << 31;

/// Turns the solid cells that are 4-connected with `seed` into free ones.
void fill(TruthGrid& grid, std::int64_t seed) {
  std::vector<std::int64_t> seeds{seed};
  TruthCell* const cells = grid.cells.data();
  while (!seeds.empty()) {
    const std::int64_t at = seeds.back();
    seeds.pop_back();
    if (cells[at] != TruthCell::solid) continue;
    const std::int64_t row = at - at % grid.width, end = row + grid.width;
    std::int64_t first = at, last = at;
    while (first > row && cells[first - 1] == TruthCell::solid) --first;
    while (last + 1 < end && cells[last + 1] == TruthCell::solid) ++last;
    for (std::int64_t i = first; i <= last; ++i) cells[i] = TruthCell::free;
    for (const std::int64_t step : {-grid.width, grid.width}) {
      if (row + step < 0 || row + step >= grid.width * grid.height) continue;
      bool in_run = false;  // one seed for each run of the neighbouring row
      for (std::int64_t i = first + step; i <= last + step; ++i) {
        const bool open = cells[i] == TruthCell::solid;
        if (open && !in_run) seeds.push_back(i);
        in_run = open;
      }
    }
  }
}

}  // namespace

TruthGrid rasterise(const raycast::World& world, double cell_m, raycast::Point inside) {
  TruthGrid grid = raster(take_apart(world), cell_m, {&inside, 1}, kMostCells);
  for (TruthCell& cell : grid.cells)
    if (cell == TruthCell::free) cell = TruthCell::solid;
  const std::int64_t seed =
      (cell_of(inside.y_m, cell_m) - grid.y) * grid.width + (cell_of(inside.x_m, cell_m) - grid.x);
  if (grid.cells[static_cast<std::size_t>(seed)] == TruthCell::surface)
    throw std::invalid_argument("the point (" + std::to_string(inside.x_m) + ", " + std::to_string(inside.y_m) +
                                ") lies in a cell of " + std::to_string(cell_m) + " m that holds a surface");
  fill(grid, seed);
  return grid;
}

std::optional<raycast::Point> first_off_surfaces(const raycast::World& world, double cell_m,
                                                 std::span<const raycast::Point> points) {
  const TruthGrid grid = raster(take_apart(world), cell_m, points, kMostCells);
  for (const raycast::Point& p : points) {
    const std::int64_t at = (cell_of(p.y_m, cell_m) - grid.y) * grid.width + (cell_of(p.x_m, cell_m) - grid.x);
    if (grid.cells[static_cast<std::size_t>(at)] != TruthCell::surface) return p;
  }
  return std::nullopt;
}

}  // namespace evigrid::scenes
