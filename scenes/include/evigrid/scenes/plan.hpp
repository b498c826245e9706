// SPDX-License-Identifier: Apache-2.0
// A floor plan: a bitmap with a scale and a place, and the walls traced from it. Row 0 of `cells` is the smallest y, as
// in a map; images have it on top and are turned over when read. Formats: ROS map_server yaml + PGM (P2, P5), PNG, BMP;
// a bare image with its size (Stage); MovingAI octile maps.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "evigrid/raycast/world.hpp"
#include "evigrid/scenes/scene.hpp"

namespace evigrid::scenes {

enum class PlanCell : std::uint8_t { free, occupied, unknown };

struct FloorPlan {
  std::int64_t width = 0, height = 0;  ///< pixels
  double resolution_m = 0;             ///< side of a pixel along x
  double resolution_y_m = 0;           ///< along y: differs only for a Stage bitmap that is stretched to a size
  Pose origin{};                       ///< of the lower left corner of the lower left pixel, in the map frame
  std::vector<PlanCell> cells;         ///< row-major, row 0 at the bottom

  [[nodiscard]] PlanCell at(std::int64_t x, std::int64_t y) const {
    return cells[static_cast<std::size_t>(y * width + x)];
  }
};

/// What an image alone does not say. Defaults: those of map_server.
struct ImageScale {
  std::optional<double> resolution_m;           ///< side of a pixel; or
  std::optional<raycast::Point> size_m;         ///< of the whole image (Stage)
  std::optional<Pose> origin;                   ///< default: the image's lower left corner at (0, 0); with size_m: centred
  bool negate = false;                          ///< white is wall
  double occupied_threshold = 0.65, free_threshold = 0.196;
};

/// Reads a plan by its extension: .yaml/.yml (map_server), .map (MovingAI), .pgm/.png/.bmp (needs `scale`).
/// Throws SceneError naming file, line where there is one, and field. Sizes are checked before memory is asked for.
[[nodiscard]] FloorPlan load_plan(const std::filesystem::path& file, const ImageScale& scale = {});

struct TraceOptions {
  double simplify_px = 0.75;      ///< outlines may leave the pixels' edges by as much; 0: exact pixel edges
  bool unknown_is_wall = false;   ///< else only occupied pixels are
  bool border_is_wall = false;    ///< a wall around the whole image (Stage's `boundary`)
  raycast::Material material{};
};

/// The outlines between wall and not wall as closed polygons in the map frame.
[[nodiscard]] std::vector<raycast::Polygon> trace(const FloorPlan& plan, const TraceOptions& options = {});

}  // namespace evigrid::scenes
