// SPDX-License-Identifier: Apache-2.0
// World and movers under one roof: which movers matter to a query, and what rays meet first of all.
#include "caster.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

namespace evigrid::raycast {
namespace {

std::vector<Surface> take_apart_mover(const World& shape, std::size_t i) {
  try {
    return take_apart(shape);
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument("mover " + std::to_string(i) + ": " + e.what());
  }
}

/// Where an average surface has more of them in its bucket, cones are faster by Embree's point query.
constexpr double kCrowd = 64;

/// Right and left end of a packet that is narrow.
Arc ends_of(const Rays& rays) {
  const Vec2 first = rays.direction(0), last = rays.direction(kPacket - 1);
  return cross(first, last) >= 0 ? Arc{first, last} : Arc{last, first};
}

/// The rays that may meet a circle around the mover's origin.
Lanes lanes_near(const Rays& rays, Lanes asked, Vec2 centre, double radius_m, const Hits& hits) {
  Lanes near = 0;
  for (Lanes rest = asked; rest != 0; rest &= rest - 1) {
    const int k = std::countr_zero(rest);
    const Vec2 towards = centre - rays.origin(k), u = rays.direction(k);
    const double along = dot(u, towards);
    if (std::abs(cross(u, towards)) <= radius_m && along >= -radius_m && along - radius_m <= hits.first_m[k])
      near |= Lanes{1} << k;
  }
  return near;
}

}  // namespace

Caster::Caster(const World& fixed, std::span<const World> shapes, Index index)
    : world(take_apart(fixed), 0, false, device) {
  if (index != Index::embree) buckets = std::make_unique<BucketGrid>(world.surfaces());
  if (index == Index::automatic && buckets->crowd() > kCrowd) buckets.reset();
  movers.reserve(shapes.size());
  for (std::size_t i = 0; i < shapes.size(); ++i)
    movers.push_back(std::make_unique<SurfaceIndex>(take_apart_mover(shapes[i], i), static_cast<std::uint32_t>(1 + i),
                                                    true, device));
}

void Caster::check(Placements placements) const {
  if (!placements.empty() && placements.size() != movers.size())
    throw std::invalid_argument("movers: " + std::to_string(placements.size()) + " placements for " +
                                std::to_string(movers.size()) + " movers");
  for (const Placement& p : placements)
    if (!std::isfinite(p.x_m) || !std::isfinite(p.y_m) || !std::isfinite(p.yaw_rad))
      throw std::invalid_argument("movers: a placement is not finite");
}

std::vector<Standing> Caster::around(Vec2 point, double range_m, const Wedge* wedge, Placements placements) const {
  std::vector<Standing> near;
  for (std::size_t i = 0; i < placements.size(); ++i)
    if (may_reach(Vec2{placements[i].x_m, placements[i].y_m} - point, movers[i]->reach_m(), range_m, wedge))
      near.push_back({movers[i].get(), Frame(placements[i])});
  return near;
}

void Caster::first_hits(const Rays& rays, Lanes asked, std::span<const Standing> near, Hits& hits) const {
  world.first_hits(rays, asked, hits);
  if (near.empty()) return;
  Wedge wedge;
  double farthest_m = 0;
  if (rays.narrow) {
    wedge.arc = ends_of(rays);
    farthest_m = *std::max_element(hits.first_m, hits.first_m + kPacket);
  }
  for (const Standing& mover : near) {
    const double radius_m = mover.index->reach_m();
    if (!rays.narrow)
      hit_mover(rays, lanes_near(rays, asked, mover.frame.origin, radius_m + kContact_m, hits), mover, hits);
    else if (may_reach(mover.frame.origin - rays.origin(0), radius_m, farthest_m, &wedge))
      hit_mover(rays, asked, mover, hits);
  }
}

void Caster::hit_mover(const Rays& rays, Lanes asked, const Standing& mover, Hits& hits) {
  if (asked == 0) return;
  Rays local;
  for (Lanes rest = rays.narrow ? first_lanes(kPacket) : asked; rest != 0; rest &= rest - 1) {
    const int k = std::countr_zero(rest);
    local.set(k, mover.frame.point_from_map(rays.origin(k)), mover.frame.direction_from_map(rays.direction(k)));
  }
  local.one_origin = rays.one_origin && rays.narrow;
  local.left_from = rays.left_from;
  mover.index->first_hits(local, asked, hits);
}

}  // namespace evigrid::raycast
