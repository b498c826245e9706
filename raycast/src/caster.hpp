// SPDX-License-Identifier: Apache-2.0
// What a Scene holds: an index of the world and one of each moving object, and the casting over all of them that cones,
// fans, second bounces and cross-talk share. Queries are already checked here.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "bucket_grid.hpp"
#include "embree_device.hpp"
#include "evigrid/raycast/scene.hpp"
#include "placed.hpp"
#include "surface_index.hpp"
#include "wedge.hpp"

namespace evigrid::raycast {

using Placements = Scene::Placements;

/// Whether a circle of this radius around `centre` (seen from the apex) may reach into the wedge nearer than range_m.
inline bool may_reach(Vec2 centre, double radius_m, double range_m, const Wedge* wedge) {
  const double radius = radius_m + kContact_m + 1e-9 * radius_m, farthest = range_m + radius;
  if (dot(centre, centre) > farthest * farthest) return false;
  return wedge == nullptr || (cross(wedge->arc.right, centre) >= -radius && cross(centre, wedge->arc.left) >= -radius);
}

struct Caster {
  Caster(const World& fixed, std::span<const World> shapes, Index index);

  EmbreeDevice device;
  SurfaceIndex world;
  std::unique_ptr<const BucketGrid> buckets;  ///< of the world, for cones; none: they go by `world` as well
  std::vector<std::unique_ptr<SurfaceIndex>> movers;

  /// Throws when there is not one finite placement per mover (or none at all).
  void check(Placements placements) const;

  /// The movers that reach into the wedge (everywhere without one) nearer than range_m.
  [[nodiscard]] std::vector<Standing> around(Vec2 point, double range_m, const Wedge* wedge,
                                             Placements placements) const;

  /// Of the world and of some movers together. A packet of more than one ray from one origin has a ray in every lane,
  /// asked or not; others have it where they are asked.
  void first_hits(const Rays& rays, Lanes asked, std::span<const Standing> near, Hits& hits) const;
  static void hit_mover(const Rays& rays, Lanes asked, const Standing& mover, Hits& hits);
  void fan(const FanQuery& q, double* ranges_m, Placements placements) const;

  [[nodiscard]] const Surface& surface(SurfaceName n) const {
    return owner_of(n) == 0 ? world.surface(surface_of(n)) : movers[owner_of(n) - 1]->surface(surface_of(n));
  }
  /// The named surface seen from a point of the map.
  [[nodiscard]] Surface seen(SurfaceName n, Vec2 point, Placements placements) const {
    const Frame frame = owner_of(n) == 0 ? Frame() : Frame(placements[owner_of(n) - 1]);
    return frame.seen(surface(n), frame.point_from_map(point));
  }
};

struct Scene::Impl : Caster {
  using Caster::Caster;
};

}  // namespace evigrid::raycast
