// SPDX-License-Identifier: Apache-2.0
#include "tour/drivable.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "evigrid/scenes/tour.hpp"
#include "tour/distance.hpp"
#include "truth/raster.hpp"

namespace evigrid::scenes {
DriveGrid drive_grid(const Outline& outline, const Nearby& nearby, double clearance_m, double cell_m,
                     std::span<const raycast::Point> include, std::int64_t most_cells) {
  if (!(clearance_m > 0) || !std::isfinite(clearance_m)) throw std::invalid_argument("clearance_m is not positive");
  if (!(cell_m > 0) || !std::isfinite(cell_m)) throw std::invalid_argument("cell_m is not positive");
  cell_m = std::min(cell_m, clearance_m);
  const TruthGrid surfaces = raster(outline, cell_m, include, std::min(most_cells, kMostTourCells));
  DriveGrid grid;
  grid.x = surfaces.x;
  grid.y = surfaces.y;
  grid.width = surfaces.width;
  grid.height = surfaces.height;
  grid.cell_m = cell_m;
  grid.clearance_sq = squared_distance(surfaces);
  grid.drivable.assign(surfaces.cells.size(), 0);
  // Half a diagonal step away from both centres.
  grid.leg_clearance_m = std::sqrt(clearance_m * clearance_m - cell_m * cell_m / 2) * (1 - 1e-9);

  // The surface nearest to a centre lies in its nearest surface cell up to half a diagonal: between the bounds,
  // measure.
  const double half = std::numbers::sqrt2 / 2 + 1e-4, cells = clearance_m / cell_m;
  const double no = cells > half ? (cells - half) * (cells - half) : -1, yes = (cells + half) * (cells + half);
  for (std::int64_t row = 1; row + 1 < grid.height; ++row) {
    for (std::int64_t column = 1; column + 1 < grid.width; ++column) {
      const auto i = static_cast<CellIndex>(row * grid.width + column);
      const double d = grid.clearance_sq[i];
      if (d <= no) continue;
      const raycast::Point p = grid.centre(i);
      grid.drivable[i] = d >= yes || nearby.keeps(p, p, clearance_m);
    }
  }
  return grid;
}

std::vector<Step> steps(const DriveGrid& grid) {
  const std::int64_t w = grid.width;
  return {{1, kStraight},     {-1, kStraight},    {w, kStraight},      {-w, kStraight},
          {w + 1, kDiagonal}, {w - 1, kDiagonal}, {-w + 1, kDiagonal}, {-w - 1, kDiagonal}};
}

std::vector<std::uint8_t> main_region(const DriveGrid& grid) {
  constexpr std::size_t kInnerIsWorth = 8;
  const std::vector<Step> around = steps(grid);
  std::vector<std::uint8_t> seen(grid.drivable.size(), 0), best(grid.drivable.size(), 0);
  std::vector<CellIndex> region, inner, outer;
  for (std::size_t seed = 0; seed < seen.size(); ++seed) {
    if (!grid.drivable[seed] || seen[seed]) continue;
    region.assign(1, static_cast<CellIndex>(seed));
    seen[seed] = 1;
    bool open = false;
    for (std::size_t k = 0; k < region.size(); ++k) {
      const std::int64_t column = region[k] % grid.width, row = region[k] / grid.width;
      open = open || column == 1 || row == 1 || column == grid.width - 2 || row == grid.height - 2;
      for (const Step& step : around) {
        const auto next = static_cast<CellIndex>(region[k] + step.offset);
        if (!grid.drivable[next] || seen[next]) continue;
        seen[next] = 1;
        region.push_back(next);
      }
    }
    std::vector<CellIndex>& rival = open ? outer : inner;
    if (region.size() > rival.size()) rival.swap(region);
  }
  for (const CellIndex i : inner.size() * kInnerIsWorth >= outer.size() ? inner : outer) best[i] = 1;
  return best;
}

}  // namespace evigrid::scenes
