// SPDX-License-Identifier: Apache-2.0
// Chessboard distances in two passes (Rosenfeld, Pfaltz 1966), exact for the metric max(|dx|, |dy|); the image ends in
// walls. Units: pixels.
#include "widest_place.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace evigrid::driver {
namespace {

using Cells = std::vector<std::int32_t>;

/// Free space joined to the image's border is often the world outside of the building: a region that is not is taken
/// unless the other one is this many times as large.
constexpr std::size_t kInnerIsWorth = 8;

class Grid {
 public:
  explicit Grid(const scenes::FloorPlan& plan) : plan_(plan) {}
  [[nodiscard]] bool free(std::int64_t x, std::int64_t y) const {
    return x >= 0 && y >= 0 && x < plan_.width && y < plan_.height && plan_.at(x, y) == scenes::PlanCell::free;
  }
  [[nodiscard]] std::size_t index(std::int64_t x, std::int64_t y) const {
    return static_cast<std::size_t>(y * plan_.width + x);
  }

  [[nodiscard]] Cells distances() const {
    Cells d(plan_.cells.size(), 0);
    const auto relax = [&](std::int64_t x, std::int64_t y, std::int64_t dx, std::int64_t dy, std::int32_t best) {
      return std::min(best, free(x + dx, y + dy) ? d[index(x + dx, y + dy)] + 1 : 1);
    };
    constexpr std::int64_t kBefore[4][2] = {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}};
    for (std::int64_t y = 0; y < plan_.height; ++y)
      for (std::int64_t x = 0; x < plan_.width; ++x) {
        if (!free(x, y)) continue;
        std::int32_t best = INT32_MAX;
        for (const auto& k : kBefore) best = relax(x, y, k[0], k[1], best);
        d[index(x, y)] = best;
      }
    for (std::int64_t y = plan_.height; y-- > 0;)
      for (std::int64_t x = plan_.width; x-- > 0;) {
        if (!free(x, y)) continue;
        std::int32_t best = d[index(x, y)];
        for (const auto& k : kBefore) best = relax(x, y, -k[0], -k[1], best);
        d[index(x, y)] = best;
      }
    return d;
  }

  /// Free pixels joined to the border.
  [[nodiscard]] std::vector<bool> outside() const {
    std::vector<bool> reached(plan_.cells.size(), false);
    std::vector<std::pair<std::int64_t, std::int64_t>> open;
    const auto reach = [&](std::int64_t x, std::int64_t y) {
      if (!free(x, y) || reached[index(x, y)]) return;
      reached[index(x, y)] = true;
      open.emplace_back(x, y);
    };
    for (std::int64_t x = 0; x < plan_.width; ++x) reach(x, 0), reach(x, plan_.height - 1);
    for (std::int64_t y = 0; y < plan_.height; ++y) reach(0, y), reach(plan_.width - 1, y);
    while (!open.empty()) {
      const auto [x, y] = open.back();
      open.pop_back();
      reach(x - 1, y), reach(x + 1, y), reach(x, y - 1), reach(x, y + 1);
    }
    return reached;
  }

 private:
  const scenes::FloorPlan& plan_;
};

/// A connected set of pixels where the robot has room.
struct Region {
  std::size_t pixels = 0, widest = 0;  // how many, and the one with the largest distance
};

/// The largest region off the border and the largest one joined to it, of pixels at least `least` from everything.
std::pair<Region, Region> largest_regions(const scenes::FloorPlan& plan, const Cells& distance,
                                          const std::vector<bool>& outside, double least) {
  std::vector<bool> seen(distance.size(), false);
  std::vector<std::size_t> open;
  std::pair<Region, Region> best;
  const auto width = static_cast<std::size_t>(plan.width);
  for (std::size_t seed = 0; seed < distance.size(); ++seed) {
    Region region{0, seed};
    const auto reach = [&](std::size_t i) {
      if (seen[i] || distance[i] < least) return;
      seen[i] = true;
      ++region.pixels;
      if (distance[i] > distance[region.widest]) region.widest = i;
      open.push_back(i);
    };
    reach(seed);
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      if (i % width > 0) reach(i - 1);
      if (i % width + 1 < width) reach(i + 1);
      if (i >= width) reach(i - width);
      if (i + width < distance.size()) reach(i + width);
    }
    Region& rival = outside[seed] ? best.second : best.first;
    if (region.pixels > rival.pixels) rival = region;
  }
  return best;
}

}  // namespace

std::optional<raycast::Point> widest_place(const scenes::FloorPlan& plan, double clearance_m) {
  const Grid grid(plan);
  const Cells distance = grid.distances();
  if (distance.empty()) return std::nullopt;
  const double pixel_m = std::min(plan.resolution_m, plan.resolution_y_m);
  // From a pixel's middle to the next wall it is half a pixel less; another one for simplified outlines.
  const auto [inner, outer] =
      largest_regions(plan, distance, grid.outside(), std::max(clearance_m / pixel_m + 1.5, 1.0));
  std::size_t at = inner.pixels * kInnerIsWorth >= outer.pixels ? inner.widest : outer.widest;
  if (inner.pixels + outer.pixels == 0) {  // nowhere enough room: the best there is
    at = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
    if (distance[at] == 0) return std::nullopt;
  }
  const auto best = static_cast<std::int64_t>(at);
  const scenes::Pose middle{(static_cast<double>(best % plan.width) + 0.5) * plan.resolution_m,
                            (static_cast<double>(best / plan.width) + 0.5) * plan.resolution_y_m, 0};
  const scenes::Pose place = scenes::compose(plan.origin, middle);
  return raycast::Point{place.x_m, place.y_m};
}

}  // namespace evigrid::driver
