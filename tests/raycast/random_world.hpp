// SPDX-License-Identifier: Apache-2.0
// Furnished rooms and cones in them, from a seed: the same on every machine (no std::distribution).
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>

#include "evigrid/raycast/cone.hpp"
#include "evigrid/raycast/noise.hpp"
#include "evigrid/raycast/world.hpp"

namespace evigrid::raycast::testing {

inline constexpr double kDegree = std::numbers::pi / 180;

class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(random_bits({seed_, 0, 0, count_++}, 0) >> 11);
  }
  int below(int n) { return static_cast<int>(uniform(0, n)); }

 private:
  std::uint64_t seed_, count_ = 0;
};

/// A third echoes at every incidence, the rest only within 5° to 60°.
inline Material any_material(Random& r) { return r.below(3) == 0 ? Material{} : Material{r.uniform(5, 60) * kDegree}; }

/// A room of 8 × 6 m; shapes may overlap and cut one another.
inline World random_room(Random& r) {
  World w;
  const auto place = [&] { return Point{r.uniform(0, 8), r.uniform(0, 6)}; };
  w.polygons.push_back({{{0, 0}, {8, 0}, {8, 6}, {0, 6}}, any_material(r)});
  for (int i = 0; i < 4; ++i)
    w.boxes.push_back({place(), r.uniform(0.2, 1.5), r.uniform(0.2, 0.8), r.uniform(-4, 4), any_material(r)});
  for (int i = 0; i < 6; ++i) w.circles.push_back({place(), r.uniform(0.002, 0.05), any_material(r)});
  for (int i = 0; i < 2; ++i) w.circles.push_back({place(), r.uniform(0.1, 0.6), any_material(r)});
  for (int i = 0; i < 4; ++i) w.walls.push_back({place(), place(), any_material(r)});
  w.polygons.push_back({{place(), place(), place()}, any_material(r)});
  return w;
}

inline ConeQuery random_cone(Random& r) {
  return {.x_m = r.uniform(0.1, 7.9),
          .y_m = r.uniform(0.1, 5.9),
          .yaw_rad = r.uniform(-7, 7),
          .aperture_rad = r.uniform(1, 40) * kDegree,
          .min_range_m = r.uniform(0, 0.3),
          .max_range_m = r.uniform(1, 6)};
}

}  // namespace evigrid::raycast::testing
