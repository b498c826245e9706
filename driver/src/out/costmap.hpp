// SPDX-License-Identifier: Apache-2.0
// Costs for robots that plan on them, as NumPy arrays: the same bytes that Map::render puts into a host's buffer.
#pragma once
#include <string>

#include "evigrid/map.hpp"

namespace evigrid::driver {

/// Head of a NumPy file (version 1.0), C order. @param descr "<f4", "|i1", "|u1"; @param shape "(4, 2, 3)".
std::string npy_head(const std::string& descr, const std::string& shape);

/// occupancy.npy: nav_msgs/OccupancyGrid data, int8 (height, width), −1 no information, 0 … 100; row 0 smallest y.
std::string occupancy_npy(const Map&, CellRect);
/// costmap.npy: costmap_2d, uint8 (height, width), 255 no information, 254 lethal, 0 free; row 0 smallest y.
std::string costmap_npy(const Map&, CellRect);
/// costmap.pgm: the same bytes as an image, row 0 the largest y.
std::string costmap_pgm(const Map&, CellRect);

}  // namespace evigrid::driver
