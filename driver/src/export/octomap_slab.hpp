// SPDX-License-Identifier: Apache-2.0
// The map as a slab of voxels in an OctoMap .bt file. Optional: built where OctoMap is installed.
#pragma once
#include <iosfwd>

#include "export/export.hpp"

namespace evigrid::driver {

bool octomap_is_built() noexcept;

/// Voxels of the map's cells: occupied where BetP is above `occupied`, free where it is below `free`, none elsewhere;
/// voxel and cell have the same borders in x and y. Throws InputError where the map leaves the 65 536 voxels a side of
/// an octree, or the slab is thicker than the cap allows.
void write_octomap(const Exported& what, const ExportOptions& options, std::ostream& out);

}  // namespace evigrid::driver
