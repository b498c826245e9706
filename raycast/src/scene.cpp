// SPDX-License-Identifier: Apache-2.0
// Casting a cone. Nearly always the nearest surface point in the cone, found by one shrinking query, gives the echo
// itself: nothing nearer can hide it. Only where that point throws the sound away is visibility solved, over the
// surfaces of the world and of all movers near by.
#include "evigrid/raycast/scene.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "caster.hpp"
#include "nearest_echo.hpp"
#include "parallel.hpp"
#include "query.hpp"
#include "visibility.hpp"
#include "wedge.hpp"

namespace evigrid::raycast {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What both visitors know: from where, and in whose frame.
class FromApex : public SurfaceIndex::Visitor {
 public:
  /// Visits one index; the apex is a point of the map.
  void visit_all(const SurfaceIndex& index, const Frame& frame, Vec2 apex, double radius_m) {
    frame_ = frame;
    apex_ = frame.point_from_map(apex);
    index.visit_near(apex_, radius_m, *this);
  }

 protected:
  [[nodiscard]] Surface seen(const Surface& s) const { return frame_.seen(s, apex_); }

 private:
  Frame frame_;
  Vec2 apex_;
};

/// The nearest echo of one index.
class Nearest : public FromApex, public NearestEcho {
 public:
  using NearestEcho::NearestEcho;
  double visit(const Surface& surface, std::uint32_t, double radius_m) override {
    consider(seen(surface));
    return std::min(radius_m, first_m());
  }
};

/// All surfaces near by, in the order of their numbers whatever order the tree gives.
class Collect : public FromApex {
 public:
  void add_all(const SurfaceIndex& index, const Frame& frame, Vec2 apex, double radius_m) {
    found_.clear();
    visit_all(index, frame, apex, radius_m);
    std::sort(found_.begin(), found_.end());
    for (std::uint32_t i : found_) surfaces.push_back(seen(index.surface(i)));
  }
  double visit(const Surface&, std::uint32_t i, double radius_m) override {
    found_.push_back(i);
    return radius_m;
  }
  std::vector<Surface> surfaces;

 private:
  std::vector<std::uint32_t> found_;
};

}  // namespace

Echo Caster::cone(const ConeQuery& q, Placements placements) const {
  const Vec2 apex{q.x_m, q.y_m};
  const Wedge wedge = make_wedge(q.yaw_rad, q.aperture_rad);
  const double reach_m = q.max_range_m + kContact_m;
  Nearest nearest(wedge, q.max_range_m);
  nearest.visit_all(world, {}, apex, reach_m);
  for (std::size_t i = 0; i < placements.size(); ++i) {
    const double limit_m = std::min({reach_m, nearest.echo_m, nearest.silent_m}) + kContact_m;
    if (may_reach(Vec2{placements[i].x_m, placements[i].y_m} - apex, movers[i]->reach_m(), limit_m, &wedge))
      nearest.visit_all(*movers[i], Frame(placements[i]), apex, limit_m);
  }
  const double first_m = std::min(nearest.echo_m, nearest.silent_m);
  if (first_m > reach_m) return {};
  // A silent surface at the same distance might be the one in front: that is for the exact solution.
  if (nearest.echo_m + kContact_m < nearest.silent_m || nearest.echo_m == 0) return echo_at(nearest.echo_m, q);
  return echo_at(nearest_visible_m(q, wedge, placements), q);
}

double Caster::nearest_visible_m(const ConeQuery& q, const Wedge& wedge, Placements placements) const {
  const Vec2 apex{q.x_m, q.y_m};
  const double reach_m = q.max_range_m + kContact_m;
  Collect near;
  near.add_all(world, {}, apex, reach_m);
  for (const Standing& mover : around(apex, reach_m, &wedge, placements))
    near.add_all(*mover.index, mover.frame, apex, reach_m);
  return nearest_visible_echo(near.surfaces, wedge, q.max_range_m);
}

Scene::Scene(const World& world, std::span<const World> movers) : impl_(new Impl(world, movers)) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

std::size_t Scene::surface_count() const noexcept {
  std::size_t count = impl_->world.size();
  for (const auto& mover : impl_->movers) count += mover->size();
  return count;
}

Echo Scene::cast_cone(const ConeQuery& q, Placements movers) const {
  check(q);
  impl_->check(movers);
  return impl_->cone(q, movers);
}

void Scene::cast_cones(std::span<const ConeQuery> queries, std::span<Echo> echoes, Placements movers,
                       int threads) const {
  if (queries.size() != echoes.size()) throw std::invalid_argument("cast_cones: not one echo per query");
  impl_->check(movers);
  for (const ConeQuery& q : queries) check(q);
  for_each_block(queries.size(), 32, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) echoes[i] = impl_->cone(queries[i], movers);
  });
}

}  // namespace evigrid::raycast
