// SPDX-License-Identifier: Apache-2.0
// The algorithm box: one batch of scans into the grid.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "evigrid/map.hpp"
#include "grid/admission.hpp"
#include "grid/change_log.hpp"
#include "grid/tile_store.hpp"
#include "scan/compiled.hpp"

namespace evigrid {

class DeviceMap;  // device/device_map.hpp

struct Pipeline {
  const MapParams& params;
  const kernels::KernelTable& table;
  const std::vector<CompiledSensor>& sensors;
  TileStore& store;
  ChangeLog& changes;
  Executor& executor;
  std::vector<std::uint64_t>& tiles_per_worker;
  const Admission& admission;
  bool undo = false;                             // takes the scans back
  std::unique_ptr<DeviceMap>* device = nullptr;  // null, or what fuses instead of the table; dropped when it fails,
  std::string* note = nullptr;                   // and why
};

struct Scratch;  // scratch.hpp

Report integrate(const Pipeline&, Scratch&, std::span<const Scan>);

}  // namespace evigrid
