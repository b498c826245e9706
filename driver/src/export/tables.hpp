// SPDX-License-Identifier: Apache-2.0
// The formats for scripts: CSV, a row a seen cell, and NumPy, a file a plane.
#pragma once
#include "export/export.hpp"

namespace evigrid::driver {

/// Head line "ix,iy,…" or "x_m,y_m,…", then the planes; floats are the shortest decimals that give back the same bits.
void write_csv(const Exported& what, const std::vector<ExportPlane>& planes, bool metres, std::ostream& out);

/// PLANE.npy (version 1.0, float32, C order, row 0 the smallest y) of each plane over the whole rectangle, and
/// grid.json, which says where the rectangle lies.
void write_npy(const Exported& what, const std::vector<ExportPlane>& planes, const ExportOptions& options, OutDir& out);

}  // namespace evigrid::driver
