// SPDX-License-Identifier: Apache-2.0
// Up to 16 rays at once, as arrays of their components, and what they met. This is the exact half of ray casting: a
// surface proposed by a hierarchy (or by a list) is met here in double, so that answers do not depend on who proposed.
#pragma once
#include <cstdint>
#include <limits>

#include "surface.hpp"
#include "vec2.hpp"

namespace evigrid::raycast {

inline constexpr int kPacket = 16;

/// Names a surface of a scene: who owns it (0: the world, 1 + i: mover i) and which it is there.
using SurfaceName = std::uint64_t;
inline constexpr SurfaceName kNobody = ~SurfaceName{0};
inline SurfaceName name_of(std::uint32_t owner, std::uint32_t surface) { return SurfaceName{owner} << 32 | surface; }
inline std::uint32_t owner_of(SurfaceName n) { return static_cast<std::uint32_t>(n >> 32); }
inline std::uint32_t surface_of(SurfaceName n) { return static_cast<std::uint32_t>(n); }

/// Which lanes of a packet: bit k stands for ray k.
using Lanes = std::uint32_t;
inline Lanes first_lanes(int count) { return (Lanes{1} << count) - 1; }

struct alignas(64) Rays {
  double origin_x[kPacket], origin_y[kPacket];
  double direction_x[kPacket], direction_y[kPacket];  ///< unit vectors
  bool one_origin = false;                            ///< all start at the same point
  bool narrow = false;                                ///< and all look between the first and the last, less than π
  /// The surface that a ray starts on, if any; null when no ray does. A straight one is not met again, a circle only
  /// on its far side.
  const SurfaceName* left_from = nullptr;

  [[nodiscard]] Vec2 origin(int k) const { return {origin_x[k], origin_y[k]}; }
  [[nodiscard]] Vec2 direction(int k) const { return {direction_x[k], direction_y[k]}; }
  void set(int k, Vec2 from, Vec2 towards) {
    origin_x[k] = from.x, origin_y[k] = from.y;
    direction_x[k] = towards.x, direction_y[k] = towards.y;
  }
};

struct alignas(64) Hits {
  double first_m[kPacket];     ///< in: look no farther; out: the first surface if nearer
  double heard_m[kPacket];     ///< the first surface among those heard from where they are met
  SurfaceName first[kPacket];  ///< who is there; of several, the one with the smallest name
  double max_range_m = 0;      ///< of the sensor: decides what is heard

  void clear(int lanes, double limit_m, double sensor_range_m) {
    for (int k = 0; k < lanes; ++k) {
      first_m[k] = limit_m;
      heard_m[k] = std::numeric_limits<double>::infinity();
      first[k] = kNobody;
    }
    max_range_m = sensor_range_m;
  }
};

/// Meets a surface with the asked rays and keeps what is nearer. Returns the lanes whose first hit changed.
Lanes meet(const Surface& s, SurfaceName name, const Rays& rays, Lanes asked, Hits& hits);

}  // namespace evigrid::raycast
