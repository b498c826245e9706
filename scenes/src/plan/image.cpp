// SPDX-License-Identifier: Apache-2.0
// The rule of map_server (map_server/src/image_loader.cpp, nav2_map_server/src/map_io.cpp): p = (255 − v)/255 of the
// mean colour v, occupied if p > occupied_thresh, free if p < free_thresh. Different from them: with an alpha channel
// map_server's trinary mode counts alpha as one more colour ("to preserve existing behavior"); here a pixel that is not
// opaque is unknown, as in their scale mode. Opaque black and white give the same either way.
#include "image.hpp"

#include <cmath>

namespace evigrid::scenes {
namespace {

std::int8_t meaning(const Shading& shading, std::uint32_t level, std::uint32_t white) {
  const std::uint32_t dark = shading.negate ? level : white - level;
  if (shading.mode == ShadeMode::raw) {
    const double per_cent = std::round(255.0 * (white - dark) / white);
    return per_cent > 100 ? kUnknown : static_cast<std::int8_t>(per_cent);
  }
  const double p = static_cast<double>(dark) / white;
  if (p > shading.occupied_threshold) return kOccupied;
  if (p < shading.free_threshold) return kFree;
  if (shading.mode == ShadeMode::trinary) return kUnknown;
  const double width = shading.occupied_threshold - shading.free_threshold;
  return static_cast<std::int8_t>(1 + 98 * (width > 0 ? (p - shading.free_threshold) / width : 0));
}

}  // namespace

PixelRule::PixelRule(const Shading& shading, std::uint32_t white) : ignore_alpha_(shading.mode == ShadeMode::raw) {
  cells_.reserve(white + std::size_t{1});
  for (std::uint32_t level = 0; level <= white; ++level) cells_.push_back(meaning(shading, level, white));
}

PlanCell cell_of(std::int8_t occupancy, const Shading& shading) noexcept {
  if (occupancy == kUnknown) return PlanCell::unknown;
  if (shading.mode == ShadeMode::raw) {
    const double p = occupancy / 100.0;
    return p > shading.occupied_threshold ? PlanCell::occupied
           : p < shading.free_threshold   ? PlanCell::free
                                          : PlanCell::unknown;
  }
  return occupancy == kOccupied ? PlanCell::occupied : occupancy == kFree ? PlanCell::free : PlanCell::unknown;
}

void check_size(std::int64_t width, std::int64_t height, const std::string& name) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width <= 0 || height <= 0) throw SceneError(name + ": size: is " + size + ", both must be positive");
  if (width > kMostPixels || height > kMostPixels || width * height > kMostPixels)
    throw SceneError(name + ": size: is " + size + ", a plan has at most " + std::to_string(kMostPixels) + " pixels");
}

Bitmap::Bitmap(std::int64_t w, std::int64_t h, const std::string& name) : width(w), height(h) {
  check_size(w, h, name);
  cells.resize(static_cast<std::size_t>(w * h));
}

}  // namespace evigrid::scenes
