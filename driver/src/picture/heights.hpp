// SPDX-License-Identifier: Apache-2.0
// bel(occupied) of a map as a height field, for surfaces.
#pragma once
#include <vector>

#include "out/layers.hpp"

namespace evigrid::driver {

/// bel(occupied) at block centres, with a rim at the border of the map that brings the surface down to the ground.
struct Heights {
  int nx = 0, ny = 0;
  std::vector<double> x, y;  ///< in the box, from −½ (times the aspect) to ½
  std::vector<float> bel;
  std::vector<bool> seen;
  [[nodiscard]] std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i);
  }
};

/// Of large maps the largest value of a block, at most `most_blocks` on the longer side.
[[nodiscard]] Heights heights_of(const Layers& layers, int most_blocks);

}  // namespace evigrid::driver
