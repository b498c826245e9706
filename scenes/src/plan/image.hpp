// SPDX-License-Identifier: Apache-2.0
// From image bytes to cells: brightness becomes an occupancy as in ROS map_server, pixel by pixel while the image is
// decoded, and rows are turned over (images have row 0 on top). All readers check sizes before they ask for memory; an
// image whose data end early is an error, never a smaller image.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "evigrid/scenes/plan.hpp"

namespace evigrid::scenes {

/// 16 384 × 16 384: a building of 800 m at 5 cm.
inline constexpr std::int64_t kMostPixels = std::int64_t{1} << 28;

using Bytes = std::span<const std::byte>;

/// trinary and scale: p = 1 − brightness against two thresholds; what lies between is unknown, in scale 1 … 99. raw:
/// the pixel, 0 … 255, is the occupancy in per cent, and beyond 100 unknown.
enum class ShadeMode : std::uint8_t { trinary, scale, raw };

struct Shading {
  bool negate = false;
  double occupied_threshold = 0.65, free_threshold = 0.196;
  ShadeMode mode = ShadeMode::trinary;
};

/// Occupancies as in nav_msgs/OccupancyGrid.
inline constexpr std::int8_t kFree = 0, kOccupied = 100, kUnknown = -1;

/// What a cell of that occupancy is.
[[nodiscard]] PlanCell cell_of(std::int8_t occupancy, const Shading& shading) noexcept;

/// The occupancy that a pixel means, tabulated over all sums of its colour channels: 0 black … `white`.
class PixelRule {
 public:
  PixelRule(const Shading& shading, std::uint32_t white);

  [[nodiscard]] std::int8_t of(std::uint32_t level) const { return cells_[level]; }
  /// `opaque`: what has any transparency is unknown, except in raw mode, which has no use for alpha.
  [[nodiscard]] std::int8_t of(std::uint32_t level, bool opaque) const {
    return opaque || ignore_alpha_ ? cells_[level] : kUnknown;
  }

 private:
  std::vector<std::int8_t> cells_;
  bool ignore_alpha_;
};

struct Bitmap {
  std::int64_t width = 0, height = 0;
  std::vector<std::int8_t> cells;  ///< occupancies; row 0 at the bottom

  /// Throws SceneError unless both sides are positive and the area is at most kMostPixels.
  Bitmap(std::int64_t width, std::int64_t height, const std::string& name);
  /// `y` counts from the top, as in the file.
  [[nodiscard]] std::int8_t* row_from_top(std::int64_t y) { return cells.data() + (height - 1 - y) * width; }
};

/// Throws what the constructor of Bitmap would throw, without its memory.
void check_size(std::int64_t width, std::int64_t height, const std::string& name);

/// Each throws SceneError "name: field: ..." or "name:line: field: ...".
Bitmap read_pgm(Bytes bytes, const std::string& name, const Shading& shading);
Bitmap read_png(Bytes bytes, const std::string& name, const Shading& shading);
Bitmap read_bmp(Bytes bytes, const std::string& name, const Shading& shading);

}  // namespace evigrid::scenes
