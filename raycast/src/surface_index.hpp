// SPDX-License-Identifier: Apache-2.0
// Finds the surfaces near a point or along a ray, by Embree's hierarchy of boxes. Embree works in float, so it is only
// asked which surfaces are worth looking at, with a margin for its rounding; every distance is computed in double.
#pragma once
#include <cstdint>
#include <exception>
#include <memory>
#include <vector>

#include "surface.hpp"
#include "vec2.hpp"

namespace evigrid::raycast {

class SurfaceIndex {
 public:
  explicit SurfaceIndex(std::vector<Surface> surfaces);
  ~SurfaceIndex();
  SurfaceIndex(const SurfaceIndex&) = delete;
  SurfaceIndex& operator=(const SurfaceIndex&) = delete;

  [[nodiscard]] std::size_t size() const { return surfaces_.size(); }
  [[nodiscard]] const Surface& surface(std::uint32_t i) const { return surfaces_[i]; }

  /// Told of surfaces that may be within the radius, nearest first by and large.
  class Visitor {
   public:
    virtual ~Visitor() = default;
    /// Returns the radius to go on with: the given one or a smaller one.
    virtual double visit(std::uint32_t surface, double radius_m) = 0;
  };
  void visit_near(Vec2 point, double radius_m, Visitor& visitor) const;

  /// Distance of the first surface; +∞ when farther than max_range_m.
  [[nodiscard]] double first_hit(Vec2 origin, Vec2 direction, double max_range_m) const;

 private:
  struct Tree;
  std::vector<Surface> surfaces_;
  Vec2 centre_;          ///< of all surfaces: Embree sees coordinates relative to it, which stay small
  double radius_m_ = 0;  ///< of a circle around all surfaces
  std::unique_ptr<Tree> tree_;
};

}  // namespace evigrid::raycast
