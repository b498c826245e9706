// SPDX-License-Identifier: Apache-2.0
// The bounding box of a map as dense planes, and the files made of them. Row 0 of every plane is the smallest y; images
// turn that over, because their row 0 is on top.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "evigrid/map.hpp"

namespace evigrid::driver {

struct Layers {
  CellRect rect{};  ///< in cells of the map
  double cell_m = 0;
  std::vector<float> planes;  ///< e, o, u, conflict, one after the other

  [[nodiscard]] std::size_t cells() const { return static_cast<std::size_t>(rect.width * rect.height); }
  [[nodiscard]] const float* e() const { return planes.data(); }
  [[nodiscard]] const float* o() const { return planes.data() + cells(); }
  [[nodiscard]] const float* u() const { return planes.data() + 2 * cells(); }
  [[nodiscard]] const float* conflict() const { return planes.data() + 3 * cells(); }
};

/// Throws InputError naming the size when the planes and the picture would need more than `cap_mb`.
void require_dense_fits(const CellRect& rect, int cap_mb);
Layers render_layers(const Map& map, int cap_mb);

/// Head of a NumPy file (version 1.0) of little-endian float32, shape (4, height, width), C order.
std::string npy_head(const Layers& layers);

/// ROS map_server, mode trinary: 0 occupied, 254 free, 205 unknown, from BetP = o + u/2.
std::string pgm(const Layers& layers);
std::string map_yaml(const Layers& layers, const std::string& image);

inline constexpr double kOccupiedThreshold = 0.65, kFreeThreshold = 0.196;  ///< map_server's usual ones

}  // namespace evigrid::driver
