// SPDX-License-Identifier: Apache-2.0
// --region (also --rect): a rectangle of a saved map in metres, of which alone the file is read.
#pragma once
#include <vector>
#include "cli.hpp"

#include "evigrid/types.hpp"

namespace evigrid::driver {

/// Adds --region,--rect to a command; empty when the user gave none.
void add_region_option(CLI::App& command, std::vector<double>& region_m);

/// Cells that touch the rectangle x0,y0,x1,y1, m. Throws InputError where that is none.
CellRect cells_of(const std::vector<double>& region_m, double cell_m);

}  // namespace evigrid::driver
