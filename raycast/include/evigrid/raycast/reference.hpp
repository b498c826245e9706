// SPDX-License-Identifier: Apache-2.0
// The same question answered slowly, by another method and without Embree: for proving the caster, not for use.
#pragma once
#include "evigrid/raycast/cone.hpp"
#include "evigrid/raycast/export.hpp"
#include "evigrid/raycast/world.hpp"

namespace evigrid {
namespace EVIGRID_RAYCAST_API raycast {

/// Angular sweep over all surfaces: between neighbouring event angles the order of the surfaces cannot change, so the
/// first one is minimised analytically. O(n³). Same contract as Scene::cast_cone.
[[nodiscard]] Echo reference_cone(const World& world, const ConeQuery& query);

/// First surface along one ray by testing all of them; +∞ when farther than max_range_m.
[[nodiscard]] double reference_ray(const World& world, double x_m, double y_m, double angle_rad, double max_range_m);

}  // namespace raycast
}  // namespace evigrid
