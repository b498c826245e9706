// SPDX-License-Identifier: Apache-2.0
// Many robots of one kind in one world, each on a way of its own, and what their sensors measure. Scans are numbered:
// step s of robot r is scan s · robots + r, which is also the order of their stamps. Every number of a scan depends on
// the seed, the robot and the step alone: not on the threads, and not on when it is asked for.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "evigrid/raycast/scene.hpp"
#include "evigrid/scenes/scene.hpp"

namespace evigrid::scenes {

struct FleetSpec {
  std::size_t robots = 1;
  std::uint64_t seed = 1;  ///< of places, ways and noise
  double period_s = 0.1;   ///< from one step to the next
  double speed_m_s = 0.5, turn_rate_rad_s = 1.5;
  double margin_m = 0.05;  ///< kept from every surface beyond the robot's radius
};

/// Calls work(i) once for every i in [0, count), on whatever threads, and returns when all are done.
using Parallel = std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;
/// The calling thread alone.
inline void serially(std::size_t count, const std::function<void(std::size_t)>& work) {
  for (std::size_t i = 0; i < count; ++i) work(i);
}

/// What a fleet needs of a world and any number of fleets can share: made once, it takes seconds for a square
/// kilometre.
class Floor {
 public:
  explicit Floor(const raycast::World& world);
  ~Floor();
  Floor(Floor&&) noexcept;
  Floor& operator=(Floor&&) noexcept;

  /// Can a robot of this radius stand here? Boxes and circles are solid.
  [[nodiscard]] bool stands(raycast::Point at, double radius_m) const;
  /// Can it drive straight from a to b?
  [[nodiscard]] bool drives(raycast::Point a, raycast::Point b, double radius_m) const;
  [[nodiscard]] raycast::Point low() const noexcept;   ///< lower left corner of the world
  [[nodiscard]] raycast::Point high() const noexcept;  ///< upper right corner

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

/// Robots do not see one another and may stand in the same place.
class Fleet {
 public:
  /// Keeps references to floor and caster, which must live longer. Of `robot` the radius, the sensors and the echoes
  /// are used. Throws std::invalid_argument when no place for a robot is found.
  Fleet(const Floor& floor, const raycast::Scene& caster, Scene robot, const FleetSpec& spec,
        const Parallel& parallel = serially);
  ~Fleet();
  Fleet(Fleet&&) noexcept;
  Fleet& operator=(Fleet&&) noexcept;

  [[nodiscard]] std::size_t robots() const noexcept;
  /// Of one scan: sonars first, then the beams of all lasers.
  [[nodiscard]] std::size_t ranges_per_scan() const noexcept;
  [[nodiscard]] std::int64_t stamp_ns(std::uint64_t scan) const noexcept;

  /// Poses of scans first, first + 1, … Robots only drive onwards: the next call begins where this one ended, or later.
  void drive(std::uint64_t first, std::span<Pose> poses, const Parallel& parallel = serially);
  /// The readings of those scans, one scan after the other; NaN never, ±∞ as Step::ranges_m.
  void measure(std::uint64_t first, std::span<const Pose> poses, std::span<float> ranges_m,
               const Parallel& parallel = serially) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace evigrid::scenes
