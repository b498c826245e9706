// SPDX-License-Identifier: Apache-2.0
// The exact Euclidean distance transform (Felzenszwalb & Huttenlocher 2012): how far each cell's centre is from the
// nearest centre of a marked cell. Linear in the cells; integers inside, so the squares are exact.
#pragma once
#include <cstdint>
#include <vector>

namespace evigrid::driver {

/// @param marked row-major, width × height; not zero: marked.
/// @return squared distances in cells²; -1 everywhere when nothing is marked.
[[nodiscard]] std::vector<std::int64_t> squared_distances(const std::vector<std::uint8_t>& marked, int width,
                                                          int height);

}  // namespace evigrid::driver
