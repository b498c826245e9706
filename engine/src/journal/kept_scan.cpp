// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "evigrid/journal.hpp"

namespace evigrid {

KeptScan::KeptScan(const Scan& s) : stamp_ns(s.stamp_ns), T_map_robot(s.T_map_robot) {
  std::size_t all = 0;
  for (const Reading& r : s.readings) all += r.ranges_m.size();
  ranges_m_.reserve(all);  // so that spans into it stay
  readings_.reserve(s.readings.size());
  for (const Reading& r : s.readings) {
    const std::size_t first = ranges_m_.size();
    ranges_m_.insert(ranges_m_.end(), r.ranges_m.begin(), r.ranges_m.end());
    readings_.push_back({r.sensor, std::span<const float>(ranges_m_).subspan(first)});
  }
}

KeptScan::KeptScan(std::int64_t stamp, const Pose2& pose, std::vector<SensorId> sensors,
                   std::vector<std::uint32_t> counts, std::vector<float> ranges_m)
    : stamp_ns(stamp), T_map_robot(pose), ranges_m_(std::move(ranges_m)) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (counts.at(i) > ranges_m_.size() - first) throw std::invalid_argument("scan: fewer ranges than its readings");
    readings_.push_back({sensors[i], std::span<const float>(ranges_m_).subspan(first, counts[i])});
    first += counts[i];
  }
}

}  // namespace evigrid
