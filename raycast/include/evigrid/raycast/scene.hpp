// SPDX-License-Identifier: Apache-2.0
// A world made ready for casting. Immutable after construction: any number of threads may cast in it at once, and the
// answers do not depend on them. Floating-point modes of the calling thread are as before after every call.
#pragma once
#include <cstddef>
#include <memory>
#include <span>

#include "evigrid/raycast/cone.hpp"
#include "evigrid/raycast/export.hpp"
#include "evigrid/raycast/world.hpp"

namespace evigrid {
namespace EVIGRID_RAYCAST_API raycast {

/// How the surfaces of the world are found for cones. Both give the same answers, bit for bit: an index proposes, the
/// exact code decides. Rays and the surfaces of movers always go by Embree's hierarchies or short lists.
enum class Index {
  automatic,  ///< buckets, unless most of the walls crowd in few of them
  embree,     ///< Embree's hierarchy of boxes and its point query
  buckets     ///< a grid of buckets, many surfaces clipped at once; a cone over more than 4096 of them goes by Embree
};

class Scene {
 public:
  /// `movers`: shapes of moving objects, each in a frame of its own; where they stand is said at every cast, so that
  /// nothing is rebuilt when they move. Throws std::invalid_argument for a non-finite coordinate, a negative size, a
  /// critical incidence outside [0, π/2] or an absorption outside [0, 1); std::runtime_error when the ray caster cannot
  /// be set up.
  explicit Scene(const World& world, std::span<const World> movers = {}, Index index = Index::automatic);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  /// One Placement per mover; an empty span leaves all movers out. Any other count throws std::invalid_argument.
  using Placements = std::span<const Placement>;

  /// The nearest surface point in the closed cone that gives an echo and is not hidden: exact to about 1e-9 m.
  /// A sensor that stands on a surface sees it at distance 0. Throws std::invalid_argument for a bad query.
  [[nodiscard]] Echo cast_cone(const ConeQuery& query, Placements movers = {}) const;

  /// The same for many cones (thousands of poses): echoes[i] answers queries[i]; equal to one call each, bit for bit.
  /// Fastest when cones that start near one another, like those of a ring, follow one another: what is around them is
  /// gathered once. `threads`: 0 for as many as the machine has, and never more; on a TBB arena of its own. Throws
  /// before any echo is written when one of the queries is bad.
  void cast_cones(std::span<const ConeQuery> queries, std::span<Echo> echoes, Placements movers = {},
                  int threads = 1) const;

  /// The echo of cast_cone, or that of a second bounce where it comes first: sound thrown away by a surface beyond its
  /// critical incidence is followed, as from a mirror, to the next surface; when that one sends it back the same way,
  /// d2 + d1, the sonar halves the whole way and reads d1 + d2: too long (Li et al. 2014, false reflection). `rays`
  /// directions sample the cone, both edges included: the way found is never shorter than the shortest one.
  [[nodiscard]] Echo cast_cone_second_bounce(const ConeQuery& query, Placements movers = {}, int rays = 32) const;

  /// Cross-talk: `speaker` and `listener` ping at the same moment, and the listener takes the speaker's sound for its
  /// own: half the shortest way speaker → surface → listener with both cones looking at the point and nothing in
  /// between, among `rays` directions of the listener's cone. The surface sends it on where the bisector of the
  /// directions to both is within its critical incidence. The smaller of both ranges limits what is heard; the
  /// listener's min_range_m counts. EchoStatus::none when there is none. Whether its own echo comes first is for the
  /// caller to compare.
  [[nodiscard]] Echo cross_talk(const ConeQuery& speaker, const ConeQuery& listener, Placements movers = {},
                                int rays = 32) const;

  /// Distance to the first surface along one ray, whatever its incidence (laser); +∞ when farther than max_range_m
  /// (closed), or when the surface absorbs too much. A straight surface that the laser stands on is not seen.
  [[nodiscard]] double ray_range(double x_m, double y_m, double angle_rad, double max_range_m,
                                 Placements movers = {}) const;

  /// Lasers: the first surface along each ray of a fan, in packets of 16 coherent rays. ranges_m has query.beams
  /// elements; equals ray_range of the same directions to 1e-9 m. Throws std::invalid_argument for a bad query or size.
  void cast_fan(const FanQuery& query, std::span<double> ranges_m, Placements movers = {}) const;

  /// Many fans, one after the other in ranges_m (total of their beams). `threads` as for cast_cones.
  void cast_fans(std::span<const FanQuery> queries, std::span<double> ranges_m, Placements movers = {},
                 int threads = 1) const;

  /// What cones go by: embree or buckets.
  [[nodiscard]] Index index() const noexcept;

  /// Straight pieces and circles after taking boxes and polygons apart, movers included.
  [[nodiscard]] std::size_t surface_count() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace raycast
}  // namespace evigrid
