// SPDX-License-Identifier: Apache-2.0
// The bounding box of a map as dense planes, and the files made of them. Row 0 of every plane is the smallest y; images
// turn that over, because their row 0 is on top.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "evigrid/map.hpp"

namespace evigrid::driver {

struct Layers {
  CellRect rect{};  ///< in cells of the map
  double cell_m = 0;
  /// One after the other: e, o, u, conflict, and, where the map keeps them, c, Con and the last conflict.
  std::vector<float> planes;
  int paradox = -1, con = -1, last_conflict = -1;  ///< which plane; −1 is none

  [[nodiscard]] std::size_t cells() const { return static_cast<std::size_t>(rect.width * rect.height); }
  [[nodiscard]] const float* e() const { return planes.data(); }
  [[nodiscard]] const float* o() const { return planes.data() + cells(); }
  [[nodiscard]] const float* u() const { return planes.data() + 2 * cells(); }
  [[nodiscard]] const float* conflict() const { return planes.data() + 3 * cells(); }
  /// Cell i of an optional plane, 0 without it.
  [[nodiscard]] float optional(int plane, std::size_t i) const {
    return plane < 0 ? 0.0F : planes[static_cast<std::size_t>(plane) * cells() + i];
  }
  [[nodiscard]] Mass mass(std::size_t i) const { return {e()[i], o()[i], u()[i], optional(paradox, i)}; }
  [[nodiscard]] std::size_t count() const { return cells() == 0 ? 4 : planes.size() / cells(); }
};

/// Throws InputError naming the output and its size when that is above `cap_mb`.
void require_fits(std::string_view name, std::string_view size, double bytes, int cap_mb);
/// The same for masses.npy and map.pgm of a rectangle.
void require_dense_fits(const CellRect& rect, int cap_mb);
/// The planes of the map's bounding box, for the files above.
Layers render_layers(const Map& map, int cap_mb);
/// The planes of a rectangle, for the output `name`.
Layers render_layers(const Map& map, const CellRect& rect, std::string_view name, int cap_mb);

/// "e, o, u, running sum of conflict …": what the planes are.
std::string plane_names(const Layers& layers);
/// Head of a NumPy file (version 1.0) of little-endian float32, shape (planes, height, width), C order.
std::string npy_head(const Layers& layers);

/// How ROS map_server reads an image. trinary: 0 occupied, 254 free, 205 unknown, by the thresholds. scale: the grey is
/// BetP, white 0, black 1; between the thresholds the loader makes 1 … 99 of it, and a PGM has no way to say unknown
/// (never seen is 1/2). raw: the byte is the occupancy, 0 … 100 = BetP in per cent, 255 never seen.
enum class PgmMode { trinary, scale, raw };
/// Throws InputError naming the option.
PgmMode parse_pgm_mode(const std::string& name, const char* option = "--pgm-mode");
inline constexpr double kOccupiedThreshold = 0.65, kFreeThreshold = 0.196;  ///< map_server's usual ones

/// What BetP must be above, and below.
struct PgmThresholds {
  double occupied = kOccupiedThreshold, free = kFreeThreshold;
};
std::string pgm(const Layers& layers, PgmMode mode = PgmMode::trinary, const PgmThresholds& = {});
/// In the mode trinary the pixels are decided already: the yaml then has the usual thresholds, by which a reader takes
/// 205 for unknown.
std::string map_yaml(const Layers& layers, const std::string& image, PgmMode mode = PgmMode::trinary,
                     const PgmThresholds& = {});

}  // namespace evigrid::driver
