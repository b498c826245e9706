// SPDX-License-Identifier: Apache-2.0
// Nearly always the nearest surface point in the cone, found by one shrinking search, gives the echo itself: nothing
// nearer can hide it. Only where that point throws the sound away is visibility solved, over the surfaces of the world
// and of all movers near by. Which index proposes the surfaces does not matter to the answer.
#include "cone.hpp"

#include <algorithm>
#include <cmath>

#include "query.hpp"

namespace evigrid::raycast {
namespace {

/// Sensors this near to the first one of a ring share its neighbourhood.
constexpr double kRing_m = 1;

/// Asks about what one index finds; the apex is a point of the map.
template <typename Asked>
class Asking : public SurfaceIndex::Visitor {
 public:
  Asking(const SurfaceIndex& index, const Frame& frame, Vec2 apex, Asked& asked)
      : index_(index), frame_(frame), apex_(frame.point_from_map(apex)), asked_(asked) {}
  void ask() { index_.visit_near(apex_, asked_.limit_m(), *this); }
  double visit(const Surface& surface, std::uint32_t i, double radius_m) override {
    asked_.consider(frame_.seen(surface, apex_), index_.name(i));
    return std::min(radius_m, asked_.limit_m());
  }

 private:
  const SurfaceIndex& index_;
  const Frame& frame_;
  Vec2 apex_;
  Asked& asked_;
};

struct Extent {
  Vec2 low, high;
  void add(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

/// Everything in the wedge within reach_m: its apex, its corners, and where the arc is farthest to a side.
void add_wedge(Extent& box, Vec2 apex, const Wedge& w, double reach_m) {
  box.add(apex);
  box.add(apex + reach_m * w.arc.right);
  box.add(apex + reach_m * w.arc.left);
  for (const Vec2 side : {Vec2{1, 0}, {0, 1}, {-1, 0}, {0, -1}})
    if (cross(w.arc.right, side) >= 0 && cross(side, w.arc.left) >= 0) box.add(apex + reach_m * side);
}

}  // namespace

ConeCaster::Room& ConeCaster::room() {
  static thread_local Room room;
  return room;
}

std::size_t ConeCaster::neighbourhood(std::span<const ConeQuery> queries) {
  constexpr std::size_t kMost = 64;
  std::size_t count = 1;
  while (count < std::min(queries.size(), kMost) && std::abs(queries[count].x_m - queries[0].x_m) <= kRing_m &&
         std::abs(queries[count].y_m - queries[0].y_m) <= kRing_m)
    ++count;
  return count;
}

void ConeCaster::cast(std::span<const ConeQuery> queries, Echo* echoes) {
  while (!queries.empty()) {
    const std::size_t count = neighbourhood(queries);
    gather(queries.first(count));
    for (std::size_t i = 0; i < count; ++i) *echoes++ = cone(queries[i], room_.wedges[i]);
    queries = queries.subspan(count);
  }
}

void ConeCaster::gather(std::span<const ConeQuery> queries) {
  const Vec2 centre{queries[0].x_m, queries[0].y_m};
  Extent box{centre, centre};
  double farthest_m = 0;
  room_.wedges.clear();
  HalfOpening half(queries[0].aperture_rad);
  for (const ConeQuery& q : queries) {
    const Vec2 apex{q.x_m, q.y_m};
    if (q.aperture_rad != half.aperture_rad) half = HalfOpening(q.aperture_rad);
    const Wedge& wedge = room_.wedges.emplace_back(make_wedge(q.yaw_rad, half));
    const double reach_m = q.max_range_m + kContact_m;
    if (caster_.buckets) add_wedge(box, apex, wedge, reach_m);
    farthest_m = std::max(farthest_m, length(apex - centre) + reach_m);
  }
  buckets_ = caster_.buckets && caster_.buckets->gather(box.low, box.high, centre, room_.around);
  room_.movers.clear();
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    const Vec2 at{placements_[i].x_m, placements_[i].y_m};
    if (may_reach(at - centre, caster_.movers[i]->reach_m(), farthest_m + kContact_m, nullptr))
      room_.movers.push_back({caster_.movers[i].get(), at, i});
  }
}

Echo ConeCaster::cone(const ConeQuery& q, const Wedge& wedge) {
  const Vec2 apex{q.x_m, q.y_m};
  NearestEcho nearest(wedge, q.max_range_m);
  ask_all(apex, wedge, nearest);
  if (nearest.first_m() > q.max_range_m + kContact_m) return {};
  // A silent surface at the same distance might be the one in front: that is for the exact solution.
  if (nearest.echo_m + kContact_m < nearest.silent_m || nearest.echo_m == 0) return echo_at(nearest.echo_m, q);
  VisibleEcho& visible = room_.visible;
  visible.begin(wedge, q.max_range_m);
  ask_all(apex, wedge, visible);
  return echo_at(visible.solve(), q);
}

template <typename Asked>
void ConeCaster::ask_all(Vec2 apex, const Wedge& wedge, Asked& asked) {
  if (buckets_)
    caster_.buckets->search(caster_.world.surfaces(), room_.around, wedge, apex, asked, room_.search);
  else
    Asking(caster_.world, {}, apex, asked).ask();
  for (const Near& mover : room_.movers) {
    if (!may_reach(mover.centre - apex, mover.index->reach_m(), asked.limit_m(), &wedge)) continue;
    const Frame frame(placements_[mover.which]);
    Asking(*mover.index, frame, apex, asked).ask();
  }
}

}  // namespace evigrid::raycast
