// SPDX-License-Identifier: Apache-2.0
#include "prior_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "error.hpp"

namespace evigrid::driver {
namespace {

constexpr double kAligned = 1e-6;  // of a cell: what decimals of an origin lose

/// Whole cells from the grid's zero to the plan's corner, where plan and grid have the same borders.
std::optional<CellIndex> shift_of(const scenes::FloorPlan& plan) {
  const double x = plan.origin.x_m / plan.resolution_m, y = plan.origin.y_m / plan.resolution_m;
  const double far = static_cast<double>(std::max(plan.width, plan.height));
  if (std::abs(plan.origin.yaw_rad) * far > kAligned || std::abs(x - std::round(x)) > kAligned ||
      std::abs(y - std::round(y)) > kAligned)
    return std::nullopt;
  return CellIndex{std::llround(x), std::llround(y)};
}

/// All cells that may have their centre in the plan.
CellRect cells_around(const scenes::FloorPlan& plan) {
  const double c = plan.resolution_m, w = static_cast<double>(plan.width) * c, h = static_cast<double>(plan.height) * c;
  const double cos = std::cos(plan.origin.yaw_rad), sin = std::sin(plan.origin.yaw_rad);
  std::array<double, 4> x{0, w * cos, -h * sin, w * cos - h * sin}, y{0, w * sin, h * cos, w * sin + h * cos};
  const auto low = [&](const std::array<double, 4>& v, double o) {
    return static_cast<std::int64_t>(std::floor((o + *std::min_element(v.begin(), v.end())) / c));
  };
  const auto high = [&](const std::array<double, 4>& v, double o) {
    return static_cast<std::int64_t>(std::ceil((o + *std::max_element(v.begin(), v.end())) / c));
  };
  const std::int64_t x0 = low(x, plan.origin.x_m), y0 = low(y, plan.origin.y_m);
  return {x0, y0, high(x, plan.origin.x_m) - x0, high(y, plan.origin.y_m) - y0};
}

}  // namespace

PriorMap map_of(const scenes::FloorPlan& plan, const PriorOptions& o) {
  if (!(o.certainty > 0 && o.certainty <= 1))
    throw InputError(fmt::format("--certainty: {} is not within (0, 1]", o.certainty));
  if (std::abs(plan.resolution_m - plan.resolution_y_m) > 1e-9 * plan.resolution_m)
    throw InputError("the plan's pixels are not square, a grid's cells are");
  const MapParams params{.cell_m = plan.resolution_m, .rule = o.rule};
  if (const auto errors = check(params); !errors.empty())
    throw InputError(errors.front().field + " " + errors.front().reason);
  PriorMap out{Map(params), false};
  const std::optional<CellIndex> shift = shift_of(plan);
  out.aligned = shift.has_value();
  const CellRect all = shift ? CellRect{shift->x, shift->y, plan.width, plan.height} : cells_around(plan);
  const double cos = std::cos(plan.origin.yaw_rad), sin = std::sin(plan.origin.yaw_rad), c = plan.resolution_m;
  const auto under = [&](std::int64_t ix, std::int64_t iy) -> std::int8_t {
    std::int64_t px = 0, py = 0;
    if (shift) {
      px = ix - shift->x, py = iy - shift->y;
    } else {
      const double dx = (static_cast<double>(ix) + 0.5) * c - plan.origin.x_m,
                   dy = (static_cast<double>(iy) + 0.5) * c - plan.origin.y_m;
      px = static_cast<std::int64_t>(std::floor((dx * cos + dy * sin) / c));
      py = static_cast<std::int64_t>(std::floor((dy * cos - dx * sin) / c));
      if (px < 0 || py < 0 || px >= plan.width || py >= plan.height) return -1;
    }
    return plan.occupancy[static_cast<std::size_t>(py * plan.width + px)];
  };
  constexpr std::int64_t kRows = 64;
  std::vector<std::int8_t> strip;
  try {
    for (std::int64_t y = all.y; y < all.y + all.height; y += kRows) {
      const CellRect part{all.x, y, all.width, std::min(kRows, all.y + all.height - y)};
      strip.clear();
      for (std::int64_t iy = y; iy < y + part.height; ++iy) {
        for (std::int64_t ix = part.x; ix < part.x + part.width; ++ix) strip.push_back(under(ix, iy));
      }
      out.map.write(part, strip, part.width, o.certainty);
    }
  } catch (const std::length_error& full) {
    throw InputError(fmt::format("the map grows beyond its memory cap: {}", full.what()));
  }
  return out;
}

}  // namespace evigrid::driver
