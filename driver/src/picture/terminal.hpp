// SPDX-License-Identifier: Apache-2.0
// A map in a terminal, for whoever is logged in on the robot: half blocks in 24-bit colour, or letters.
#pragma once
#include <string>

#include "out/layers.hpp"
#include "picture/look.hpp"

namespace evigrid::driver {

/// The map with square blocks of `block` cells a side, the remainder in smaller ones at the far sides. A block is its
/// most occupied cell when that is believed occupied (thin walls stay), else the mean of its cells; conflict: largest.
Layers coarse(const Layers& layers, std::int64_t block);

/// @param columns of characters to fill at most. Throws InputError for looks that are no map (panels, surface).
std::string terminal_picture(Look look, const Layers& layers, int columns, bool colour);

/// Columns of the terminal on standard output; 80 when it is none.
int terminal_columns();
/// Standard output is a terminal that a person watches.
bool on_terminal();

}  // namespace evigrid::driver
