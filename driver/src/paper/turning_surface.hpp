// SPDX-License-Identifier: Apache-2.0
// bel(occupied) over x and y (Li et al. 2006, Fig. 14.12) as a part of a page that turns under the mouse: a canvas and
// a script of its own, nothing fetched.
#pragma once
#include <string>

#include "out/layers.hpp"

namespace evigrid::driver {

/// Markup for Page::raw. Drag or arrow keys turn, the wheel or + and − zoom, a double click puts it back.
/// @param id unique within the page: letters and digits.
[[nodiscard]] std::string turning_surface(const Layers& layers, const std::string& id);

}  // namespace evigrid::driver
