// SPDX-License-Identifier: Apache-2.0
#include "paper/cluttered_room.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "evigrid/raycast/noise.hpp"

namespace evigrid::driver {
namespace {

constexpr int kThings = 30;
constexpr double kMiddle_m = 5;

}  // namespace

raycast::World cluttered_room(std::uint64_t seed, double free_m) {
  const auto critical = [](double deg) { return raycast::Material{deg * std::numbers::pi / 180, 0}; };
  raycast::World room;
  room.polygons.push_back(
      {{{0, 0}, {1, 0}, {1, -1.2}, {2.4, -1.2}, {2.4, 0}, {10, 0}, {10, 10}, {0, 10}}, critical(65)});
  for (std::uint64_t draw = 0; room.boxes.size() < kThings; ++draw) {
    const auto between = [&](std::uint32_t which, double low, double high) {
      return low + (high - low) * static_cast<double>(raycast::random_bits({seed, 1, 0, draw}, which) >> 11) * 0x1p-53;
    };
    raycast::Box box{{between(0, 0.3, 9.7), between(1, 0.3, 9.7)}, between(2, 0.4, 2), between(3, 0.4, 1)};
    // Most of what stands in a room stands along its walls.
    box.yaw_rad =
        between(4, 0, 1) < 0.7 ? (between(5, 0, 1) < 0.5 ? 0 : std::numbers::pi / 2) : between(5, 0, std::numbers::pi);
    box.material = critical(between(6, 0, 1) < 0.5 ? 70 : 75);  // metal, carton
    const double c = std::cos(box.yaw_rad), s = std::sin(box.yaw_rad);
    const double dx = kMiddle_m - box.centre.x_m, dy = kMiddle_m - box.centre.y_m;
    const double along = std::max(std::abs(c * dx + s * dy) - box.length_m / 2, 0.0);
    const double across = std::max(std::abs(c * dy - s * dx) - box.width_m / 2, 0.0);
    if (std::hypot(along, across) >= free_m) room.boxes.push_back(box);
  }
  return room;
}

}  // namespace evigrid::driver
