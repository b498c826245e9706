// SPDX-License-Identifier: Apache-2.0
// Footprints: a box of cells that a reading may touch. Conservative (the kernel decides every cell), cheap, and never
// written to the map: rounding here cannot change a bit of it.
#pragma once
#include <cstdint>

#include "scan/compiled.hpp"

namespace evigrid {

/// Box of cells, inclusive.
struct CellBox {
  std::int64_t x0, y0, x1, y1;
};
CellBox cone_box(const kernels::ConeReading&);
CellBox fan_box(const kernels::Fan&);

}  // namespace evigrid
