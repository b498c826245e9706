// SPDX-License-Identifier: Apache-2.0
// What is known without a sensor: masses, a prior occupancy grid, a footprint. Map::write says what each means.
#pragma once
#include "life/edit.hpp"

namespace evigrid {

void write_masses(const Grid&, CellRect rect, std::span<const Mass>, std::ptrdiff_t stride);
void write_occupancy(const Grid&, CellRect rect, std::span<const std::int8_t>, std::ptrdiff_t stride, double certainty);
void write_polygon(const Grid&, std::span<const Point2> polygon, const Mass&);

}  // namespace evigrid
