// SPDX-License-Identifier: Apache-2.0
// Letters of 5 × 7 pixels for titles and legends: printable ASCII, seven rows from the top, bit 4 on the left.
#pragma once
#include <array>
#include <cstdint>

namespace evigrid::driver {

using Glyph = std::array<std::uint8_t, 7>;

/// The glyph of a printable ASCII character; a box for every other.
const Glyph& glyph_of(char c) noexcept;

}  // namespace evigrid::driver
