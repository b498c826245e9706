// SPDX-License-Identifier: Apache-2.0
// Casting a cone. Nearly always the nearest surface point in the cone, found by one shrinking query, gives the echo
// itself: nothing nearer can hide it. Only where that point throws the sound away is visibility solved.
#include "evigrid/raycast/scene.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "query.hpp"
#include "surface_index.hpp"
#include "tolerance.hpp"
#include "visibility.hpp"
#include "wedge.hpp"

namespace evigrid::raycast {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Nearest surface point that gives an echo, and nearest one that does not.
class Nearest : public SurfaceIndex::Visitor {
 public:
  Nearest(const SurfaceIndex& index, Vec2 apex, const Wedge& wedge) : index_(index), apex_(apex), wedge_(wedge) {}

  double visit(std::uint32_t i, double radius_m) override {
    const Surface s = seen_from(index_.surface(i), apex_);
    const auto point = nearest_in_wedge(s, wedge_);
    if (!point) return radius_m;
    double& nearest = gives_echo(s, *point) ? echo_m : silent_m;
    nearest = std::min(nearest, length(*point));
    return std::min({radius_m, echo_m, silent_m});
  }

  double echo_m = kInfinity, silent_m = kInfinity;

 private:
  const SurfaceIndex& index_;
  Vec2 apex_;
  const Wedge& wedge_;
};

class Collect : public SurfaceIndex::Visitor {
 public:
  double visit(std::uint32_t i, double radius_m) override {
    surfaces.push_back(i);
    return radius_m;
  }
  std::vector<std::uint32_t> surfaces;
};

}  // namespace

struct Scene::Impl {
  SurfaceIndex index;
};

Scene::Scene(const World& world, std::span<const World>) : impl_(new Impl{SurfaceIndex(take_apart(world))}) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

std::size_t Scene::surface_count() const noexcept { return impl_->index.size(); }

Echo Scene::cast_cone(const ConeQuery& q, Placements) const {
  check(q);
  const Vec2 apex{q.x_m, q.y_m};
  const Wedge wedge = make_wedge(q.yaw_rad, q.aperture_rad);
  const double reach_m = q.max_range_m + kContact_m;
  Nearest nearest(impl_->index, apex, wedge);
  impl_->index.visit_near(apex, reach_m, nearest);
  const double first_m = std::min(nearest.echo_m, nearest.silent_m);
  if (first_m > reach_m) return {};
  // A silent surface at the same distance might be the one in front: that is for the exact solution.
  if (nearest.echo_m + kContact_m < nearest.silent_m || nearest.echo_m == 0) return echo_at(nearest.echo_m, q);

  Collect collect;
  impl_->index.visit_near(apex, reach_m, collect);
  std::sort(collect.surfaces.begin(), collect.surfaces.end());  // whatever order the tree gave
  std::vector<Surface> around;
  around.reserve(collect.surfaces.size());
  for (std::uint32_t i : collect.surfaces) around.push_back(seen_from(impl_->index.surface(i), apex));
  return echo_at(nearest_visible_echo(around, wedge, reach_m), q);
}

double Scene::ray_range(double x_m, double y_m, double angle_rad, double max_range_m, Placements) const {
  check_ray(x_m, y_m, angle_rad, max_range_m);
  return impl_->index.first_hit({x_m, y_m}, {std::cos(angle_rad), std::sin(angle_rad)}, max_range_m);
}

}  // namespace evigrid::raycast
