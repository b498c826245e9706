// SPDX-License-Identifier: Apache-2.0
#include "truth/raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace evigrid::scenes {
namespace {

using raycast::Point;
__extension__ typedef __int128 Wide;  // NOLINT: products of two lattice lengths

constexpr std::int64_t kUnit = 65536;        // lattice steps per cell
constexpr double kFarthest_cells = 0x1p31;   // |index| of any cell
constexpr std::int64_t kNarrow = 1LL << 30;  // lengths below it have products in 64 bits
constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();

std::int64_t lattice(double coordinate_m, double cell_m) {
  const double cells = coordinate_m / cell_m;
  if (!(std::abs(cells) < kFarthest_cells))
    throw std::length_error("the world reaches " + std::to_string(coordinate_m) + " m: too far for cells of " +
                            std::to_string(cell_m) + " m");
  return std::llround(cells * kUnit);
}

template <class Int>
Int floor_div(Int a, Int b) {  // b > 0
  return a / b - (a % b < 0);
}
template <class Int>
Int ceil_div(Int a, Int b) {
  return a / b + (a % b > 0);
}
// Closed cells: one that begins at i·kUnit holds i·kUnit and (i+1)·kUnit.
std::int64_t first_cell(std::int64_t low) { return ceil_div(low, kUnit) - 1; }
std::int64_t last_cell(std::int64_t high) { return floor_div(high, kUnit); }

template <class Int>
Int root(Int n) {  // floor of the square root
  Int r = static_cast<Int>(std::sqrt(static_cast<long double>(n)));
  while (r * r > n) --r;
  while ((r + 1) * (r + 1) <= n) ++r;
  return r;
}

struct LatticePoint {
  std::int64_t x, y;
};

void mark(TruthGrid& grid, std::int64_t row, std::int64_t first, std::int64_t last) {
  if (last < first) return;
  const auto at = grid.cells.begin() + ((row - grid.y) * grid.width + (first - grid.x));
  std::fill_n(at, last - first + 1, TruthCell::surface);
}

/// In every row of cells, the part of the segment within the closed row spans the columns to mark.
template <class Int>
void mark_segment(TruthGrid& grid, LatticePoint a, LatticePoint b) {
  if (a.y > b.y) std::swap(a, b);
  const std::int64_t base = floor_div(std::min(a.x, b.x), kUnit);  // the sums below stay small
  const Int ax = a.x - base * kUnit, dx = b.x - a.x, dy = b.y - a.y;
  for (std::int64_t row = first_cell(a.y); row <= last_cell(b.y); ++row) {
    if (dy == 0) {
      mark(grid, row, first_cell(std::min(a.x, b.x)), last_cell(std::max(a.x, b.x)));
      continue;
    }
    const Int low = std::max(a.y, row * kUnit) - a.y, high = std::min(b.y, (row + 1) * kUnit) - a.y;
    Int left = ax * dy + low * dx, right = ax * dy + high * dx;  // x·dy where the segment enters and leaves the row
    if (dx < 0) std::swap(left, right);
    mark(grid, row, base + static_cast<std::int64_t>(ceil_div<Int>(left, dy * kUnit)) - 1,
         base + static_cast<std::int64_t>(floor_div<Int>(right, dy * kUnit)));
  }
}

/// A cell meets the circle when its nearest point is not beyond the radius and its farthest corner not within it.
template <class Int>
void mark_ring(TruthGrid& grid, LatticePoint c, std::int64_t radius) {
  const Int square = Int{radius} * radius;
  for (std::int64_t row = first_cell(c.y - radius); row <= last_cell(c.y + radius); ++row) {
    const std::int64_t low = row * kUnit - c.y, high = low + kUnit;
    const Int near = low > 0 ? low : high < 0 ? -high : 0, far = std::max(std::abs(low), std::abs(high));
    const auto reach = static_cast<std::int64_t>(root<Int>(square - near * near));
    const std::int64_t first = first_cell(c.x - reach), last = last_cell(c.x + reach);
    if (square <= far * far) {
      mark(grid, row, first, last);
      continue;
    }
    // Cells wholly within the circle: farthest |x| squared < square − far².
    const auto hole = static_cast<std::int64_t>(root<Int>(square - far * far - 1));
    const std::int64_t hole_first = ceil_div(c.x - hole, kUnit), hole_last = floor_div(c.x + hole, kUnit) - 1;
    if (hole_first > hole_last) {
      mark(grid, row, first, last);
    } else {
      mark(grid, row, first, hole_first - 1);
      mark(grid, row, hole_last + 1, last);
    }
  }
}

struct Bounds {
  std::int64_t low = kNone, high = -kNone;  // lattice
  void include(std::int64_t from, std::int64_t to) {
    low = std::min(low, from);
    high = std::max(high, to);
  }
};

}  // namespace

std::int64_t cell_of(double coordinate_m, double cell_m) { return floor_div(lattice(coordinate_m, cell_m), kUnit); }

TruthGrid raster(const Outline& outline, double cell_m, std::span<const Point> include, std::int64_t most_cells) {
  if (!(cell_m > 0) || !std::isfinite(cell_m)) throw std::invalid_argument("cell_m is not positive");
  const auto at = [&](Point p) { return LatticePoint{lattice(p.x_m, cell_m), lattice(p.y_m, cell_m)}; };
  const auto include_point = [&](Bounds& x, Bounds& y, LatticePoint p, std::int64_t radius) {
    x.include(p.x - radius, p.x + radius);
    y.include(p.y - radius, p.y + radius);
  };
  Bounds x, y;
  for (const Point& p : include) include_point(x, y, at(p), 0);
  for (const Segment& s : outline.segments) {
    include_point(x, y, at(s.a), 0);
    include_point(x, y, at(s.b), 0);
  }
  for (const Ring& r : outline.rings) include_point(x, y, at(r.centre), lattice(r.radius_m, cell_m));
  if (x.low > x.high) include_point(x, y, {0, 0}, 0);  // an empty world

  TruthGrid grid;
  grid.cell_m = cell_m;
  grid.x = first_cell(x.low) - 1;
  grid.y = first_cell(y.low) - 1;
  grid.width = last_cell(x.high) + 2 - grid.x;
  grid.height = last_cell(y.high) + 2 - grid.y;
  if (grid.width > most_cells / grid.height)
    throw std::length_error("the world has " + std::to_string(grid.width) + " x " + std::to_string(grid.height) +
                            " cells of " + std::to_string(cell_m) + " m: more than " + std::to_string(most_cells));
  grid.cells.assign(static_cast<std::size_t>(grid.width * grid.height), TruthCell::free);

  for (const Segment& s : outline.segments) {
    const LatticePoint a = at(s.a), b = at(s.b);
    if (std::max(std::abs(b.x - a.x), std::abs(b.y - a.y)) < kNarrow)
      mark_segment<std::int64_t>(grid, a, b);
    else
      mark_segment<Wide>(grid, a, b);
  }
  for (const Ring& r : outline.rings) {
    const std::int64_t radius = lattice(r.radius_m, cell_m);
    if (radius < kNarrow)
      mark_ring<std::int64_t>(grid, at(r.centre), radius);
    else
      mark_ring<Wide>(grid, at(r.centre), radius);
  }
  return grid;
}

}  // namespace evigrid::scenes
