// SPDX-License-Identifier: Apache-2.0
// Letters of 5 × 7 pixels for titles and legends, with two more rows for the tails of g, j, p, q and y: printable
// ASCII, nine rows from the top, the base line below the seventh, bit 4 on the left.
#pragma once
#include <array>
#include <cstdint>

namespace evigrid::driver {

using Glyph = std::array<std::uint8_t, 9>;

/// The glyph of a printable ASCII character; a box for every other.
const Glyph& glyph_of(char c) noexcept;

}  // namespace evigrid::driver
