// SPDX-License-Identifier: Apache-2.0
// The gate: what comes in either becomes a footprint, to be compiled (bin.hpp), or is counted by the reason it was
// refused.
#pragma once
#include <vector>

#include "evigrid/map.hpp"
#include "scan/compiled.hpp"

namespace evigrid {

/// Appends the footprints of one scan, in the order of its readings, and counts the rest in the report.
void gate_scan(const Scan&, const std::vector<CompiledSensor>&, const MapParams&, std::vector<Footprint>& out, Report&);

}  // namespace evigrid
