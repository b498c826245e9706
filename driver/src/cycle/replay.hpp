// SPDX-License-Identifier: Apache-2.0
// A scan log fused again, whole or in part.
#pragma once
#include <string>

#include "evigrid/evigrid.hpp"

namespace evigrid::driver {

enum class ReplayPart {
  all,    ///< every scan: the map of a run that was never short of time
  fused,  ///< those that the run fused: its map
  late    ///< those, then the skipped ones: what a host gets that catches up afterwards
};
/// Throws InputError naming --part.
ReplayPart parse_part(const std::string& text);

struct Replayed {
  Map map;
  Report report;
  std::uint64_t scans = 0, logged = 0;
  double fusion_s = 0;
};

/// The log begins with the empty map: `how` says what load() is told of it. Throws InputError.
Replayed replay(const std::string& path, ReplayPart part, LoadOptions how);

}  // namespace evigrid::driver
