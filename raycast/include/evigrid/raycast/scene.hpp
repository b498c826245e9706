// SPDX-License-Identifier: Apache-2.0
// A world made ready for casting. Immutable after construction: any number of threads may cast in it at once, and the
// answers do not depend on them. Floating-point modes of the calling thread are as before after every call.
#pragma once
#include <cstddef>
#include <memory>

#include "evigrid/raycast/cone.hpp"
#include "evigrid/raycast/world.hpp"

namespace evigrid::raycast {

class Scene {
 public:
  /// Throws std::invalid_argument for a non-finite coordinate, a negative size or a critical incidence outside
  /// [0, π/2]; std::runtime_error when the ray caster cannot be set up.
  explicit Scene(const World& world);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  /// The nearest surface point in the closed cone that gives an echo and is not hidden: exact to about 1e-9 m.
  /// A sensor that stands on a surface sees it at distance 0. Throws std::invalid_argument for a bad query.
  [[nodiscard]] Echo cast_cone(const ConeQuery& query) const;

  /// Distance to the first surface along one ray, whatever its incidence (laser); +∞ when farther than max_range_m.
  [[nodiscard]] double ray_range(double x_m, double y_m, double angle_rad, double max_range_m) const;

  /// Straight pieces and circles after taking boxes and polygons apart.
  [[nodiscard]] std::size_t surface_count() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace evigrid::raycast
