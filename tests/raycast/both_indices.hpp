// SPDX-License-Identifier: Apache-2.0
// A scene twice: its cones found by Embree and by buckets. Every answer is asked of both and must be the same in every
// bit, so each test over it is a test of both indices.
#pragma once
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "evigrid/raycast/scene.hpp"

namespace evigrid::raycast::testing {

class BothIndices {
 public:
  explicit BothIndices(const World& world, std::span<const World> movers = {})
      : buckets_(world, movers, Index::buckets), embree_(world, movers, Index::embree) {
    EXPECT_EQ(buckets_.index(), Index::buckets);
    EXPECT_EQ(embree_.index(), Index::embree);
  }
  using Placements = Scene::Placements;

  [[nodiscard]] Echo cast_cone(const ConeQuery& q, Placements movers = {}) const {
    return same(buckets_.cast_cone(q, movers), embree_.cast_cone(q, movers));
  }
  void cast_cones(std::span<const ConeQuery> queries, std::span<Echo> echoes, Placements movers = {},
                  int threads = 1) const {
    buckets_.cast_cones(queries, echoes, movers, threads);
    std::vector<Echo> others(echoes.size());
    embree_.cast_cones(queries, others, movers, threads);
    for (std::size_t i = 0; i < others.size(); ++i) (void)same(echoes[i], others[i]);
  }
  [[nodiscard]] Echo cast_cone_second_bounce(const ConeQuery& q, Placements movers = {}, int rays = 32) const {
    return same(buckets_.cast_cone_second_bounce(q, movers, rays), embree_.cast_cone_second_bounce(q, movers, rays));
  }
  [[nodiscard]] Echo cross_talk(const ConeQuery& speaker, const ConeQuery& listener, Placements movers = {},
                                int rays = 32) const {
    return same(buckets_.cross_talk(speaker, listener, movers, rays),
                embree_.cross_talk(speaker, listener, movers, rays));
  }
  // Rays go the same way in both.
  [[nodiscard]] double ray_range(double x_m, double y_m, double angle_rad, double max_range_m,
                                 Placements movers = {}) const {
    return buckets_.ray_range(x_m, y_m, angle_rad, max_range_m, movers);
  }
  void cast_fan(const FanQuery& query, std::span<double> ranges_m, Placements movers = {}) const {
    buckets_.cast_fan(query, ranges_m, movers);
  }
  void cast_fans(std::span<const FanQuery> queries, std::span<double> ranges_m, Placements movers = {},
                 int threads = 1) const {
    buckets_.cast_fans(queries, ranges_m, movers, threads);
  }
  [[nodiscard]] std::size_t surface_count() const { return buckets_.surface_count(); }

 private:
  static Echo same(const Echo& a, const Echo& b) {
    EXPECT_EQ(static_cast<int>(a.status), static_cast<int>(b.status)) << "the indices differ";
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.range_m), std::bit_cast<std::uint64_t>(b.range_m))
        << "the indices differ: " << a.range_m << " by buckets, " << b.range_m << " by Embree";
    return a;
  }

  Scene buckets_, embree_;
};

}  // namespace evigrid::raycast::testing
