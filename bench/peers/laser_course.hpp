// SPDX-License-Identifier: Apache-2.0
// What the laser comparisons insert, and what every engine looks like to them: scans of one fan, the same for all.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "evigrid/evigrid.hpp"

namespace evigrid::bench {

inline constexpr double kCell_m = 0.05;

struct LaserCourse {
  std::string name;
  Sensor fan;  ///< mount included; beams are cut at its max_range_m, "no echo" is left out
  std::vector<Pose2> poses;
  std::vector<float> ranges_m;  ///< fan.beams for each pose
  CellRect box;                 ///< all that any beam can reach

  [[nodiscard]] const float* scan(std::size_t i) const {
    return ranges_m.data() + i * static_cast<std::size_t>(fan.beams);
  }
  [[nodiscard]] bool used(float range_m) const { return range_m >= fan.min_range_m && range_m < fan.no_return_m; }
};

/// A recorded CARMEN log. `stride` takes every so many scans.
LaserCourse recorded(const std::string& path, double max_range_m, std::size_t stride);
/// Scans of the robot `laser180` on its tour through a generated building: no file is needed.
LaserCourse generated(std::uint64_t seed, std::size_t stride);

/// A cell by its probability of being occupied (BetP of evigrid's masses): below 0.45 free, above 0.55 occupied.
/// So near to 0.5 that one reading of any of the engines counts.
enum class Seen : std::uint8_t { unknown, free, occupied };
inline Seen seen(double p_occupied) {
  return p_occupied < 0.45 ? Seen::free : p_occupied > 0.55 ? Seen::occupied : Seen::unknown;
}

/// Another engine with an empty map that is large enough from the start.
class LaserPeer {
 public:
  virtual ~LaserPeer() = default;
  virtual void clear() = 0;                ///< not timed
  virtual void insert(std::size_t i) = 0;  ///< scan i of the course
  virtual void finish() {}                 ///< timed, after the last scan
  [[nodiscard]] virtual Seen at(CellIndex) const = 0;
  [[nodiscard]] virtual double cells_per_scan() const = 0;  ///< distinct cells that one scan changes
};
/// MRPT's COccupancyGridMap2D::insertObservation(CObservation2DRangeScan).
std::unique_ptr<LaserPeer> make_mrpt_laser(const LaserCourse&, bool widening);
/// OctoMap's OcTree::insertPointCloud, all points in the plane z = half a voxel.
std::unique_ptr<LaserPeer> make_octomap_laser(const LaserCourse&, bool lazy, bool discretize);

struct Agreement {
  double iou_free = 0, iou_occupied = 0;      ///< |both| / |either|
  double unknown_ours = 0, unknown_peer = 0;  ///< share of the cells that either engine knows
};
Agreement agreement(const Map&, const LaserPeer&, CellRect);

}  // namespace evigrid::bench
