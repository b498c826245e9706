// SPDX-License-Identifier: Apache-2.0
// Nearly always the nearest surface point in the cone, found by one shrinking search, gives the echo itself: nothing
// nearer can hide it. Only where that point throws the sound away is visibility solved, over the surfaces of the world
// and of all movers near by. Which index proposes the surfaces does not matter to the answer.
#include "cone.hpp"

#include <algorithm>
#include <cmath>

#include "query.hpp"
#include "visibility.hpp"

namespace evigrid::raycast {
namespace {

/// Sensors this near to the first one of a ring share its neighbourhood.
constexpr double kRing_m = 1;

/// Asks about what one index finds; the apex is a point of the map.
class Asking : public SurfaceIndex::Visitor {
 public:
  Asking(const Frame& frame, Vec2 apex, NearestEcho& nearest)
      : frame_(frame), apex_(frame.point_from_map(apex)), nearest_(nearest) {}
  void visit_all(const SurfaceIndex& index, double radius_m) { index.visit_near(apex_, radius_m, *this); }
  double visit(const Surface& surface, std::uint32_t, double radius_m) override {
    nearest_.consider(frame_.seen(surface, apex_));
    return std::min(radius_m, nearest_.first_m());
  }

 private:
  const Frame& frame_;
  Vec2 apex_;
  NearestEcho& nearest_;
};

/// Notes the numbers of what one index finds.
class Collecting : public SurfaceIndex::Visitor {
 public:
  explicit Collecting(std::vector<std::uint32_t>& numbers) : numbers_(numbers) {}
  double visit(const Surface&, std::uint32_t i, double radius_m) override {
    numbers_.push_back(i);
    return radius_m;
  }

 private:
  std::vector<std::uint32_t>& numbers_;
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
  for (const ConeQuery& q : queries) {
    const Vec2 apex{q.x_m, q.y_m};
    const Wedge& wedge = room_.wedges.emplace_back(make_wedge(q.yaw_rad, q.aperture_rad));
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
  if (buckets_)
    caster_.buckets->search(caster_.world.surfaces(), room_.around, wedge, apex, nearest, room_.search);
  else
    Asking({}, apex, nearest).visit_all(caster_.world, q.max_range_m + kContact_m);
  ask_movers(apex, wedge, nearest);
  if (nearest.first_m() > q.max_range_m + kContact_m) return {};
  // A silent surface at the same distance might be the one in front: that is for the exact solution.
  if (nearest.echo_m + kContact_m < nearest.silent_m || nearest.echo_m == 0) return echo_at(nearest.echo_m, q);
  return echo_at(nearest_visible_m(q, wedge), q);
}

void ConeCaster::ask_movers(Vec2 apex, const Wedge& wedge, NearestEcho& nearest) {
  for (const Near& mover : room_.movers) {
    const double limit_m = nearest.limit_m();
    if (!may_reach(mover.centre - apex, mover.index->reach_m(), limit_m, &wedge)) continue;
    const Frame frame(placements_[mover.which]);
    Asking(frame, apex, nearest).visit_all(*mover.index, limit_m);
  }
}

double ConeCaster::nearest_visible_m(const ConeQuery& q, const Wedge& wedge) {
  const Vec2 apex{q.x_m, q.y_m};
  const double reach_m = q.max_range_m + kContact_m;
  std::vector<std::uint32_t>& numbers = room_.numbers;
  numbers.clear();
  room_.surfaces.clear();
  const auto take = [&](const SurfaceIndex& index, const Frame& frame, Vec2 from) {
    for (std::uint32_t i : numbers) room_.surfaces.push_back(frame.seen(index.surface(i), from));
  };
  if (buckets_) {
    caster_.buckets->collect(room_.around, wedge, apex, reach_m, room_.search, numbers);
  } else {
    Collecting all(numbers);
    caster_.world.visit_near(apex, reach_m, all);
    std::sort(numbers.begin(), numbers.end());  // whatever order the tree gives
  }
  take(caster_.world, {}, apex);
  for (const Near& mover : room_.movers) {
    if (!may_reach(mover.centre - apex, mover.index->reach_m(), reach_m, &wedge)) continue;
    const Frame frame(placements_[mover.which]);
    const Vec2 from = frame.point_from_map(apex);
    numbers.clear();
    Collecting all(numbers);
    mover.index->visit_near(from, reach_m, all);
    std::sort(numbers.begin(), numbers.end());
    take(*mover.index, frame, from);
  }
  return nearest_visible_echo(room_.surfaces, wedge, q.max_range_m);
}

}  // namespace evigrid::raycast
