// SPDX-License-Identifier: Apache-2.0
// A user's building from above, and what a behaviour was given or found in it: ways as lines, places as points.
#pragma once
#include <string>
#include <vector>

#include "evigrid/scenes/scene.hpp"
#include "picture/furniture.hpp"

namespace evigrid::driver {

inline constexpr Rgb kGoalColour{204, 60, 140}, kThingColour{230, 120, 0}, kBuildingColour{60, 66, 82};

struct PlanDrawn {
  std::string name;  ///< for the legend; empty: not in it
  std::vector<raycast::Point> points;
  Rgb colour;
  bool line = true;  ///< else points
};

/// The true surfaces of the scene's world (what its way can reach is white) and what is drawn on them. Throws
/// InputError when the world cannot be drawn.
[[nodiscard]] Canvas draw_plan(const scenes::Scene& scene, const PictureText& text,
                               const std::vector<PlanDrawn>& drawn);

}  // namespace evigrid::driver
