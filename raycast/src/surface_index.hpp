// SPDX-License-Identifier: Apache-2.0
// Finds the surfaces near a point or along rays, by Embree's hierarchy of boxes. Embree works in float, so it is only
// asked which surfaces are worth looking at, with a margin for its rounding; every distance is computed in double.
// The few surfaces of a small moving object are simply gone through.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "rays.hpp"
#include "surface.hpp"
#include "vec2.hpp"

namespace evigrid::raycast {

class EmbreeDevice;

class SurfaceIndex {
 public:
  /// Up to this many surfaces a list is gone through: with 50 round movers in bench_cast, fans take 2.5 times as long
  /// with a hierarchy for each, cones 1.3 times.
  static constexpr std::size_t kFew = 8;

  /// `owner`: for the names of surfaces, see SurfaceName. With `list_few`, kFew surfaces or less get no hierarchy.
  SurfaceIndex(std::vector<Surface> surfaces, std::uint32_t owner, bool list_few, EmbreeDevice& device);
  ~SurfaceIndex();
  SurfaceIndex(const SurfaceIndex&) = delete;
  SurfaceIndex& operator=(const SurfaceIndex&) = delete;

  [[nodiscard]] std::size_t size() const { return surfaces_.size(); }
  [[nodiscard]] const std::vector<Surface>& surfaces() const { return surfaces_; }
  [[nodiscard]] SurfaceName name(std::uint32_t i) const { return name_of(owner_, i); }
  [[nodiscard]] const Surface& surface(std::uint32_t i) const { return surfaces_[i]; }
  /// Radius of the circle around the origin of the frame that holds all surfaces.
  [[nodiscard]] double reach_m() const { return reach_m_; }

  /// Told of surfaces that may be within the radius, nearest first by and large.
  class Visitor {
   public:
    virtual ~Visitor() = default;
    /// Returns the radius to go on with: the given one or a smaller one.
    virtual double visit(const Surface& surface, std::uint32_t i, double radius_m) = 0;
  };
  void visit_near(Vec2 point, double radius_m, Visitor& visitor) const;

  /// Keeps in `hits` what the asked rays meet nearer than what is there.
  void first_hits(const Rays& rays, Lanes asked, Hits& hits) const;

 private:
  struct Tree;
  struct Stretch;
  [[nodiscard]] Stretch stretch_of(Vec2 origin, Vec2 direction, double limit_m) const;
  void cast_one(const Rays& rays, int k, Hits& hits) const;
  void cast_packet(const Rays& rays, Lanes asked, Hits& hits) const;

  std::vector<Surface> surfaces_;
  std::uint32_t owner_;
  Vec2 centre_;          ///< of all surfaces: Embree sees coordinates relative to it, which stay small
  double radius_m_ = 0;  ///< of a circle around all surfaces
  double margin_m_ = 0;  ///< for the rounding of float coordinates
  double reach_m_ = 0;
  std::unique_ptr<Tree> tree_;  ///< none: a list
};

}  // namespace evigrid::raycast
