// SPDX-License-Identifier: Apache-2.0
// Casting cones, one neighbourhood after the other: the sensors of a ring stand within a few decimetres, so what is
// around them is gathered once and clipped by each.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "bucket_grid.hpp"
#include "caster.hpp"
#include "evigrid/raycast/cone.hpp"
#include "nearest_echo.hpp"
#include "visibility.hpp"

namespace evigrid::raycast {

/// Casts for one call and one thread. Queries are already checked.
class ConeCaster {
 public:
  ConeCaster(const Caster& caster, Placements placements) : caster_(caster), placements_(placements) {}

  /// echoes[i] answers queries[i]; any number of them from one neighbourhood.
  void cast(std::span<const ConeQuery> queries, Echo* echoes);

  /// How many of the first queries make a neighbourhood.
  static std::size_t neighbourhood(std::span<const ConeQuery> queries);

 private:
  /// A mover that some cone of the neighbourhood may reach.
  struct Near {
    const SurfaceIndex* index;
    Vec2 centre;
    std::size_t which;
  };
  void gather(std::span<const ConeQuery> queries);
  [[nodiscard]] Echo cone(const ConeQuery& q, const Wedge& wedge);
  /// Asks about every surface of the world and of the movers that may be in the wedge within the asked one's limit.
  template <typename Asked>
  void ask_all(Vec2 apex, const Wedge& wedge, Asked& asked);

  /// Room that a thread keeps, so that no cone asks for memory.
  struct Room {
    BucketGrid::Neighbourhood around;
    BucketGrid::Room search;
    VisibleEcho visible;
    std::vector<Near> movers;
    std::vector<Wedge> wedges;
  };
  static Room& room();

  const Caster& caster_;
  Placements placements_;
  Room& room_ = room();
  bool buckets_ = false;  ///< for this neighbourhood
};

}  // namespace evigrid::raycast
