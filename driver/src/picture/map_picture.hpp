// SPDX-License-Identifier: Apache-2.0
// A map as a picture that a person reads at once: unknown mid grey, empty near white, occupied dark navy, conflict
// orange; scale bar, legend, title and the robot's path. Colours: Okabe & Ito, apart for the colour-blind too.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "evigrid/types.hpp"
#include "out/layers.hpp"
#include "picture/canvas.hpp"

namespace evigrid::driver {

struct PictureText {
  std::string title;     ///< first line
  std::string subtitle;  ///< second line, smaller
};

/// The colour of one cell: the masses mix white, navy and grey; ambivalence pulls towards orange.
Rgb cell_colour(float e, float o, float u, float conflict) noexcept;

/// @param trajectory robot or sensor poses in frame M, in order of time.
Canvas draw_map(const Layers& layers, const std::vector<Pose2>& trajectory, const PictureText& text);

}  // namespace evigrid::driver
