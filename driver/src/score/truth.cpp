// SPDX-License-Identifier: Apache-2.0
#include "score/truth.hpp"

#include <fmt/format.h>

#include <stdexcept>

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
  SceneTruth out;
  for (const scenes::Pose& pose : scenes::drive(scene.trajectory)) {  // a coarse cell may hold the start and a wall
    try {
      out.grid = scenes::rasterise(scene.world, cell_m, {pose.x_m, pose.y_m});
      return out;
    } catch (const std::invalid_argument& in_wall) {
      out.why_not = in_wall.what();
    } catch (const std::length_error& large) {
      return {std::nullopt, large.what()};
    }
  }
  return out;
}

}  // namespace evigrid::driver
