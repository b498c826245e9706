// SPDX-License-Identifier: Apache-2.0
#include "life/known_areas.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "grid/cell_state.hpp"
#include "grid/rect.hpp"

namespace evigrid {
namespace {

[[noreturn]] void refuse(const std::string& why) { throw std::invalid_argument("write: " + why); }

}  // namespace

void write_masses(const Grid& g, CellRect rect, std::span<const Mass> masses, std::ptrdiff_t stride) {
  if (rect.empty()) return;
  require_room("write", rect, masses.size(), stride);
  const auto at = [&](std::int64_t x, std::int64_t y) {
    return &masses[static_cast<std::size_t>((y - rect.y) * stride + (x - rect.x))];
  };
  for (std::int64_t y = rect.y; y < rect.y + rect.height; ++y) {
    for (std::int64_t x = rect.x; x < rect.x + rect.width; ++x) {
      if (const auto why = why_no_mass(g.params.rule, *at(x, y)); !why.empty())
        refuse("the mass of cell (" + std::to_string(x) + ", " + std::to_string(y) + ") " + std::string(why));
    }
  }
  write(g, rect, at);
}

void write_occupancy(const Grid& g, CellRect rect, std::span<const std::int8_t> values, std::ptrdiff_t stride,
                     double certainty) {
  if (rect.empty()) return;
  require_room("write", rect, values.size(), stride);
  if (!(certainty > 0 && certainty <= 1)) refuse("certainty is not in (0, 1]");
  Mass of_percent[101];
  for (int p = 0; p <= 100; ++p) {
    Mass& m = of_percent[p];
    m.e = static_cast<float>((100 - p) / 100.0 * certainty), m.o = static_cast<float>(p / 100.0 * certainty);
    m.u = static_cast<float>(1 - certainty);
  }
  const auto at = [&](std::int64_t x, std::int64_t y) {
    return values[static_cast<std::size_t>((y - rect.y) * stride + (x - rect.x))];
  };
  for (std::int64_t y = rect.y; y < rect.y + rect.height; ++y) {
    for (std::int64_t x = rect.x; x < rect.x + rect.width; ++x) {
      if (at(x, y) < -1 || at(x, y) > 100)
        refuse("cell (" + std::to_string(x) + ", " + std::to_string(y) + ") has the occupancy " +
               std::to_string(at(x, y)) + ", not within [-1, 100]");
    }
  }
  write(g, rect,
        [&](std::int64_t x, std::int64_t y) -> const Mass* { return at(x, y) < 0 ? nullptr : &of_percent[at(x, y)]; });
}

void write_polygon(const Grid& g, std::span<const Point2> polygon, const Mass& mass) {
  if (polygon.size() < 3) refuse("a polygon has at least three corners");
  if (const auto why = why_no_mass(g.params.rule, mass); !why.empty()) refuse("the mass " + std::string(why));
  const double c = g.params.cell_m, most = 1125899906842624.0 * c;  // 2^50 cells
  double x0 = most, x1 = -most, y0 = most, y1 = -most, area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    if (!(std::fabs(p.x_m) < most && std::fabs(p.y_m) < most)) refuse("a corner is not finite or too far away");
    x0 = std::min(x0, p.x_m), x1 = std::max(x1, p.x_m), y0 = std::min(y0, p.y_m), y1 = std::max(y1, p.y_m);
    area += (p.x_m - polygon[0].x_m) * (q.y_m - polygon[0].y_m) - (q.x_m - polygon[0].x_m) * (p.y_m - polygon[0].y_m);
  }
  const auto cell = [&](double v) { return static_cast<std::int64_t>(std::floor(v / c)); };
  const CellRect box{cell(x0), cell(y0), cell(x1) - cell(x0) + 1, cell(y1) - cell(y0) + 1};
  write(g, box, [&](std::int64_t x, std::int64_t y) -> const Mass* {
    const double px = (static_cast<double>(x) + 0.5) * c, py = (static_cast<double>(y) + 0.5) * c;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      const double left = (b.x_m - a.x_m) * (py - a.y_m) - (b.y_m - a.y_m) * (px - a.x_m);
      if (area > 0 ? left < 0 : left > 0) return nullptr;
    }
    return &mass;
  });
}

}  // namespace evigrid
