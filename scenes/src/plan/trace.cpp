// SPDX-License-Identifier: Apache-2.0
// From pixels to walls in metres: outlines, fewer corners, then scale, turn and shift.
#include <cmath>
#include <stdexcept>

#include "pixel_outline.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::size_t kMostCorners = 20'000'000;

void check(const FloorPlan& plan, const TraceOptions& options) {
  if (plan.width < 0 || plan.height < 0 || plan.width > INT32_MAX || plan.height > INT32_MAX ||
      plan.cells.size() != static_cast<std::size_t>(plan.width) * static_cast<std::size_t>(plan.height))
    throw std::invalid_argument("trace: the plan's cells do not fit its size");
  if (!(plan.resolution_m > 0) || !(plan.resolution_y_m > 0))
    throw std::invalid_argument("trace: the plan's resolution must be positive");
  if (!(options.simplify_px >= 0 && options.simplify_px <= 100))
    throw std::invalid_argument("trace: simplify_px must be within [0, 100]");
}

}  // namespace

std::vector<raycast::Polygon> trace(const FloorPlan& plan, const TraceOptions& options) {
  check(plan, options);
  const double c = std::cos(plan.origin.yaw_rad), s = std::sin(plan.origin.yaw_rad);
  const auto in_map = [&](std::int64_t x_px, std::int64_t y_px) -> raycast::Point {
    const double x = static_cast<double>(x_px) * plan.resolution_m, y = static_cast<double>(y_px) * plan.resolution_y_m;
    return {plan.origin.x_m + c * x - s * y, plan.origin.y_m + s * x + c * y};
  };
  std::vector<raycast::Polygon> polygons;
  if (plan.cells.empty()) return polygons;
  Simplifier simplify(options.simplify_px);
  follow_outlines(plan, options.unknown_is_wall, kMostCorners, [&](PixelRing& ring) {
    simplify(ring);
    raycast::Polygon& polygon = polygons.emplace_back();
    polygon.material = options.material;
    polygon.vertices.reserve(ring.size());
    for (const Corner& corner : ring) polygon.vertices.push_back(in_map(corner.x, corner.y));
  });
  if (options.border_is_wall)
    polygons.push_back({{in_map(0, 0), in_map(plan.width, 0), in_map(plan.width, plan.height), in_map(0, plan.height)},
                        options.material});
  return polygons;
}

}  // namespace evigrid::scenes
