// SPDX-License-Identifier: Apache-2.0
// Footprints: which tiles, and which micro-tiles of a tile, a reading may touch. Conservative (the kernel decides every
// cell), cheap, and never written to the map: rounding here cannot change a bit of it.
#pragma once
#include <array>
#include <cstdint>

#include "kernels/row/kernel_table.hpp"
#include "scan/compiled.hpp"

namespace evigrid {

/// Box of cells, inclusive.
struct CellBox {
  std::int64_t x0, y0, x1, y1;
};
CellBox footprint_box(const Footprint&);

struct MicroList {
  std::array<std::uint8_t, kernels::kMicrosPerTile> micro;
  int count = 0;
};

/// (x0, y0): offset of the tile's first cell centre from the apex, in cells.
void select_micros(const kernels::ConeReading&, double x0, double y0, MicroList& out);
}  // namespace evigrid
