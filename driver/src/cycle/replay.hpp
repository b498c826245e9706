// SPDX-License-Identifier: Apache-2.0
// A scan log fused again, whole or in part.
#pragma once
#include <memory>
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

Replayed replay(const std::string& path, ReplayPart part, Kernel kernel, std::shared_ptr<Executor> executor);

}  // namespace evigrid::driver
