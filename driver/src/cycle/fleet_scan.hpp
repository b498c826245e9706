// SPDX-License-Identifier: Apache-2.0
// One scan of one robot of a fleet, with its own memory: it may wait in a queue or a log.
#pragma once
#include <cstdint>
#include <vector>

#include "evigrid/types.hpp"

namespace evigrid::driver {

struct FleetScan {
  std::uint64_t number = 0;  ///< step · robots + robot: the order of fusion
  std::int64_t stamp_ns = 0;
  std::uint32_t robot = 0;
  Pose2 T_map_robot{};
  std::vector<float> ranges_m;  ///< of all sensors, one after the other
};

}  // namespace evigrid::driver
