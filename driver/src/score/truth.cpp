// SPDX-License-Identifier: Apache-2.0
#include "score/truth.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "evigrid/scenes/simulate.hpp"

namespace evigrid::driver {
namespace {

constexpr double kMostCells = 1 << 27;  // some seconds and half a gigabyte with the picture

}  // namespace

SceneTruth scene_truth(const scenes::Scene& scene, double cell_m) {
  const scenes::Extent box = scenes::extent(scene.world);
  const double width = (box.high.x_m - box.low.x_m) / cell_m, height = (box.high.y_m - box.low.y_m) / cell_m;
  if (!((width + 3) * (height + 3) <= kMostCells)) {
    return {std::nullopt, fmt::format("the world has {:.0f} x {:.0f} cells, too many to be scored", width, height)};
  }
  const std::vector<scenes::Pose> poses = scenes::drive(scene.trajectory);
  if (poses.empty()) return {};
  const auto from = [&](raycast::Point p) { return SceneTruth{scenes::rasterise(scene.world, cell_m, p), {}}; };
  try {
    return from({poses[0].x_m, poses[0].y_m});
  } catch (const std::length_error& large) {
    return {std::nullopt, large.what()};
  } catch (const std::invalid_argument& in_wall) {  // a coarse cell may hold the start and a wall: from the next one
    std::vector<raycast::Point> points;
    points.reserve(poses.size());
    for (const scenes::Pose& pose : poses) points.push_back({pose.x_m, pose.y_m});
    try {
      const auto free = scenes::first_off_surfaces(scene.world, cell_m, points);
      return free ? from(*free) : SceneTruth{std::nullopt, in_wall.what()};
    } catch (const std::length_error& large) {
      return {std::nullopt, large.what()};
    }
  }
}

}  // namespace evigrid::driver
