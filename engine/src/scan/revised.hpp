// SPDX-License-Identifier: Apache-2.0
// Sensors with a learned revision (Sensor::revision). The fused kernels know no networks: a reading is heard by cells
// that have heard nothing, under the conjunctive rule, which keeps what the model says as it is; those masses go
// through the network, and the map's rule hears the result.
#pragma once
#include <cstddef>
#include <vector>

#include "evigrid/map.hpp"
#include "grid/cell_layout.hpp"

namespace evigrid {

/// Planes of the cells that hear such a reading: e, o, u, c.
const std::vector<Plane>& planes_of_revised();

/// One worker's.
class RevisedReading {
 public:
  /// Masses of `micros` micro-tiles side by side, each e, o, u, c: revised where the reading said anything, and taken
  /// as the map's rule takes a first reading: what it leaves on empty ∩ occupied is given up (docs/maths.md).
  void revise(const Sensor&, const MapParams&, float* heard, std::size_t micros);

 private:
  std::vector<float> masses_;  // gathered: nothing known, the source, the answer
  std::vector<float*> cells_;  // whose
};

}  // namespace evigrid
