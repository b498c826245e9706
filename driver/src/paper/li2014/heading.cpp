// SPDX-License-Identifier: Apache-2.0
#include "paper/li2014/heading.hpp"

#include <array>
#include <cstdlib>
#include <numbers>

namespace evigrid::driver {
namespace {

constexpr float kSurelyOccupied = 0.8F;
constexpr int kSteps = 20;  // of 0.25 degrees on either side: eta within 5 degrees
constexpr double kStep_rad = 0.25 * std::numbers::pi / 180;

}  // namespace

HeadingAgent::HeadingAgent(const scenes::Scene& robot, const MapParams& params, const FieldRect& field,
                           std::shared_ptr<Executor> executor, double least_gain)
    : field_(field),
      current_(robot, params, std::move(executor)),
      least_gain_(least_gain),
      old_(field.cells()),
      now_(field.cells()) {}

double HeadingAgent::error_of(const Map& map, const scenes::Sensed& scan, const scenes::Pose& believed) {
  current_.map.clear();
  current_.fuse(scan, believed, 0);
  const CellRect& rect = field_.rect;
  map.render(Layer::bel, rect, old_, rect.width);
  current_.map.render(Layer::bel, rect, now_, rect.width);
  const double cx = believed.x_m / field_.cell_m - static_cast<double>(rect.x),
               cy = believed.y_m / field_.cell_m - static_cast<double>(rect.y);
  std::vector<raycast::Point> around;  // cells of the scan, from the robot's centre, in cells
  for (int y = 0; y < rect.height; ++y) {
    for (int x = 0; x < rect.width; ++x) {
      if (now_[field_.index({x, y})] > kSurelyOccupied) around.push_back({x + 0.5 - cx, y + 0.5 - cy});
    }
  }
  const auto matches = [&](int k) {
    const double c = std::cos(k * kStep_rad), s = std::sin(k * kStep_rad);
    int n = 0;
    for (const raycast::Point& p : around) {
      const GridCell at{static_cast<int>(std::floor(cx + c * p.x_m - s * p.y_m)),
                        static_cast<int>(std::floor(cy + s * p.x_m + c * p.y_m))};
      n += field_.inside(at) && old_[field_.index(at)] > kSurelyOccupied ? 1 : 0;
    }
    return n;
  };
  const int unturned = matches(0);
  int best = 0, most = unturned;
  for (int k = 1; k <= kSteps; ++k) {  // of equal ones the smallest turn
    for (const int turn : {k, -k}) {
      if (const int n = matches(turn); n > most) best = turn, most = n;
    }
  }
  return most < (1 + least_gain_) * unturned ? 0 : best * kStep_rad;
}

}  // namespace evigrid::driver
