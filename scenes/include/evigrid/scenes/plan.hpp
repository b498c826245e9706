// SPDX-License-Identifier: Apache-2.0
// A floor plan: a bitmap with a scale and a place, and the walls traced from it. Row 0 of `cells` is the smallest y, as
// in a map; images have it on top and are turned over when read. Formats: ROS map_server yaml + PGM (P2, P5), PNG, BMP;
// a bare image with its size (Stage); MovingAI octile maps.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
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
  std::vector<PlanCell> cells{};       ///< row-major, row 0 at the bottom
  /// The same cells as nav_msgs/OccupancyGrid has them: −1 unknown, 0 free … 100 occupied; between them only of images
  /// in the modes scale and raw. Empty in a plan that was not read from a file.
  std::vector<std::int8_t> occupancy{};

  [[nodiscard]] PlanCell at(std::int64_t x, std::int64_t y) const {
    return cells[static_cast<std::size_t>(y * width + x)];
  }
};

/// What an image alone does not say. Defaults: those of map_server. A map_server yaml says all of it itself: there only
/// `origin` may be given, and it wins. MovingAI maps have cells of 1 m unless resolution_m or size_m is given.
struct ImageScale {
  std::optional<double> resolution_m{};    ///< side of a pixel; or
  std::optional<raycast::Point> size_m{};  ///< of the whole image (Stage)
  /// Pose of the image's lower left corner. Default: (0, 0); with size_m the image is centred on (0, 0), as in Stage.
  std::optional<Pose> origin{};
  bool negate = false;  ///< white is wall
  double occupied_threshold = 0.65, free_threshold = 0.196;
};

/// Reads a plan by its extension: .yaml/.yml (map_server), .map (MovingAI), .pgm/.png/.bmp (needs `scale`).
/// Throws SceneError naming file, line where there is one, and field. Sizes are checked before memory is asked for.
[[nodiscard]] FloorPlan load_plan(const std::filesystem::path& file, const ImageScale& scale = {});

/// The same from memory. `name` stands for the file: its extension says the format, messages name it, and the image of
/// a yaml is looked for in its folder.
[[nodiscard]] FloorPlan load_plan_bytes(std::span<const std::byte> bytes, const std::filesystem::path& name,
                                        const ImageScale& scale = {});

struct TraceOptions {
  /// Outlines may leave the pixels' edges by as much; 0: exact pixel edges. Places where two walls touch at a corner
  /// only, and things up to three pixels across, keep their exact outline, so that no gap opens.
  double simplify_px = 0.75;
  bool unknown_is_wall = false;  ///< else only occupied pixels are
  bool border_is_wall = false;   ///< a wall around the whole image (Stage's `boundary`)
  raycast::Material material{};
};

/// The outlines between wall and not wall as closed polygons in the map frame; what lies outside of the image is not
/// wall. Wall pixels that touch at a corner are joined there: nothing is seen between them. Throws
/// std::invalid_argument for a plan whose cells do not fit its size or a bad option, std::length_error for one with
/// more than 20 million corners (noise, not a building).
[[nodiscard]] std::vector<raycast::Polygon> trace(const FloorPlan& plan, const TraceOptions& options = {});

}  // namespace evigrid::scenes
