// SPDX-License-Identifier: Apache-2.0
// What of a cell is exported: the layers that can be rendered, by their names, and e, o, u, c for the masses.
#pragma once
#include <string>
#include <vector>

#include "evigrid/map.hpp"

namespace evigrid::driver {

struct ExportPlane {
  std::string name;  ///< as the user gave it; a column's or a file's name
  Layer layer;
};

/// Names of all planes, comma-separated, for help texts.
std::string plane_choices();
/// Throws InputError naming --planes, the name that is unknown, given twice or not kept by the map, and the known ones.
std::vector<ExportPlane> parse_planes(const std::vector<std::string>& names, const MapParams& params);
/// e, o, u, c where the rule leaves such a mass, betp, and conflict, con, last_conflict where the map keeps them.
std::vector<ExportPlane> standard_planes(const MapParams& params);

}  // namespace evigrid::driver
