// SPDX-License-Identifier: Apache-2.0
// What integrate() works in: kept by the map from call to call for its memory, never for its contents.
#pragma once
#include <vector>

#include "grid/decay.hpp"
#include "scan/bin.hpp"
#include "scan/dependent.hpp"
#include "scan/revised.hpp"

namespace evigrid {

/// A cone whose micro-tiles are listed, not yet fused.
struct PendingCone {
  const Footprint* footprint;
  ConeList::Marks from, to;
};

/// One worker's.
struct RegionScratch {
  ConeList list;
  std::vector<PendingCone> pending;
  kernels::FanMicros fan_micros;
  DecayedUpdate decayed;
  DependentReadings together[3];  // a policy: Dependence, without independent
  DependentReadings alone;        // one reading that is no kernel's: revised
  RevisedReading revised;
  BlankMicros blank;
  std::vector<float*> blank_cells;
};

struct Scratch {
  std::vector<Footprint> footprints;
  std::vector<std::size_t> scan_end;  // of each scan, the end of its footprints
  Plan plan;
  std::vector<kernels::Stats> stats;  // a region
  std::vector<RegionScratch> workers;
};

}  // namespace evigrid
