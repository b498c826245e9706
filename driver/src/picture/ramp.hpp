// SPDX-License-Identifier: Apache-2.0
// Colour ramps that the eye reads as even steps, from their published control points: viridis (van der Walt & Smith
// 2015), and RdBu, Oranges and Greys of ColorBrewer (Brewer & Harrower 2002). All are safe for the colour-blind.
#pragma once
#include "picture/canvas.hpp"

namespace evigrid::driver {

enum class Ramp {
  viridis,  ///< probabilities: dark violet 0, yellow 1
  rdbu,     ///< around a half: blue 0, near white 1/2, red 1
  oranges,  ///< conflict: pale 0, dark orange 1
  greys     ///< the figures of 1992: white 0, black 1
};

/// @param t clamped into [0, 1]; NaN is 0.
Rgb colour_of(Ramp ramp, double t) noexcept;

/// Linear from a to b in sRGB; t is clamped.
Rgb blend(Rgb a, Rgb b, double t) noexcept;

}  // namespace evigrid::driver
