// SPDX-License-Identifier: Apache-2.0
// Where robots can stand and drive: surfaces by bins (nearby.hpp), the inside of things by their centres, sorted by x.
#include <algorithm>
#include <cmath>
#include <vector>

#include "evigrid/scenes/fleet.hpp"
#include "evigrid/scenes/truth.hpp"
#include "tour/nearby.hpp"

namespace evigrid::scenes {
namespace {

using raycast::Point;

constexpr double kBin_m = 1;  // of the nearest surfaces; speed only

/// Inside of what is thinner than twice this there is always a surface near: long walls need no look.
constexpr double kLeastClearance_m = 0.1;

/// A thing that a robot could stand in.
struct Solid {
  double x_m, y_m;       // its centre
  std::uint32_t number;  // boxes first, then circles
};

}  // namespace

struct Floor::Impl {
  explicit Impl(const raycast::World& w)
      : world(w), outline(take_apart(w)), nearby(outline, kBin_m), extent(scenes::extent(w)) {
    std::uint32_t number = 0;
    const auto add = [&](Point centre, double least_m, double around_m) {
      if (least_m > 2 * kLeastClearance_m) {
        solids.push_back({centre.x_m, centre.y_m, number});
        reach_m = std::max(reach_m, around_m);
      }
      ++number;
    };
    for (const raycast::Box& b : world.boxes)
      add(b.centre, std::min(b.length_m, b.width_m), std::hypot(b.length_m, b.width_m) / 2);
    for (const raycast::Circle& c : world.circles) add(c.centre, 2 * c.radius_m, c.radius_m);
    std::sort(solids.begin(), solids.end(), [](const Solid& a, const Solid& b) { return a.x_m < b.x_m; });
  }

  [[nodiscard]] bool within(const Solid& s, Point p) const {
    const double dx = p.x_m - s.x_m, dy = p.y_m - s.y_m;
    if (s.number >= world.boxes.size()) {
      const double r = world.circles[s.number - world.boxes.size()].radius_m;
      return dx * dx + dy * dy <= r * r;
    }
    const raycast::Box& b = world.boxes[s.number];
    if (4 * (dx * dx + dy * dy) > b.length_m * b.length_m + b.width_m * b.width_m) return false;
    const double c = std::cos(b.yaw_rad), n = std::sin(b.yaw_rad);
    return 2 * std::abs(c * dx + n * dy) <= b.length_m && 2 * std::abs(c * dy - n * dx) <= b.width_m;
  }

  raycast::World world;
  Outline outline;
  Nearby nearby;
  Extent extent;
  std::vector<Solid> solids;  // by x
  double reach_m = 0;         // of the largest one from its centre
};

Floor::Floor(const raycast::World& world) : impl_(new Impl(world)) {}
Floor::~Floor() = default;
Floor::Floor(Floor&&) noexcept = default;
Floor& Floor::operator=(Floor&&) noexcept = default;
Point Floor::low() const noexcept { return impl_->extent.low; }
Point Floor::high() const noexcept { return impl_->extent.high; }

bool Floor::drives(Point a, Point b, double radius_m) const { return impl_->nearby.keeps(a, b, radius_m); }

bool Floor::stands(Point at, double radius_m) const {
  if (!drives(at, at, std::max(radius_m, kLeastClearance_m))) return false;
  const auto& all = impl_->solids;
  const auto first = std::lower_bound(all.begin(), all.end(), at.x_m - impl_->reach_m,
                                      [](const Solid& s, double x_m) { return s.x_m < x_m; });
  for (auto s = first; s != all.end() && s->x_m <= at.x_m + impl_->reach_m; ++s)
    if (impl_->within(*s, at)) return false;
  return true;
}

}  // namespace evigrid::scenes
