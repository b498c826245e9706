// SPDX-License-Identifier: Apache-2.0
// Pictures that a person reads at once. `mixed`: unknown mid grey, empty near white, occupied dark navy, conflict
// orange. Numbers of a cell: their ramp with a colour bar. Each with title, legend, scale bar and the robot's path.
#pragma once
#include <string>
#include <vector>

#include "evigrid/types.hpp"
#include "out/layers.hpp"
#include "picture/canvas.hpp"
#include "picture/furniture.hpp"
#include "picture/look.hpp"

namespace evigrid::driver {

/// The colour of one cell: the masses mix white, navy and grey; ambivalence pulls towards orange.
Rgb cell_colour(float e, float o, float u, float conflict) noexcept;

struct PictureOptions {
  int scale = 0;                 ///< pixels a cell; 0: small maps are enlarged to about 900 pixels
  int max_image_mb = 2048;       ///< of the canvas
  std::string name = "picture";  ///< what a refusal calls it: the file's name
};

/// Any look. Throws InputError naming the file when the canvas would be larger than the cap.
/// @param trajectory robot or sensor poses in frame M, in order of time.
Canvas draw(Look, const Layers&, const std::vector<Pose2>& trajectory, const PictureText&, const PictureOptions& = {});

/// The look `mixed`.
Canvas draw_map(const Layers& layers, const std::vector<Pose2>& trajectory, const PictureText& text,
                const PictureOptions& = {});

/// m(empty), m(occupied), m(unknown) — the darker the surer — and the grey composite (Hughes & Murphy 1992, Fig. 3).
Canvas draw_panels(const Layers& layers, const std::vector<Pose2>& trajectory, const PictureText& text,
                   const PictureOptions& = {});

/// bel(occupied) over x and y in perspective (Li et al. 2006, Fig. 14.12). Of large maps the largest value of a block.
Canvas draw_surface(const Layers& layers, const PictureText& text, const PictureOptions& = {});

/// A canvas of that size, or an InputError naming the file.
Canvas canvas_within(std::int64_t width, std::int64_t height, const PictureOptions&);

}  // namespace evigrid::driver
