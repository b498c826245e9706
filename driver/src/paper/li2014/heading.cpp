// SPDX-License-Identifier: Apache-2.0
#include "paper/li2014/heading.hpp"

#include <array>
#include <cstdlib>
#include <numbers>

namespace evigrid::driver {
namespace {

constexpr float kSurely = 0.8F;
constexpr int kSteps = 20;  // of 0.25 degrees on either side: eta within 5 degrees
constexpr double kStep_rad = 0.25 * std::numbers::pi / 180;

}  // namespace

HeadingAgent::HeadingAgent(const scenes::Scene& robot, const MapParams& params, const FieldRect& field,
                           std::shared_ptr<Executor> executor, double least_gain, Match match)
    : field_(field), current_(robot, params, std::move(executor)), least_gain_(least_gain) {
  hypotheses_.push_back({Layer::bel});
  if (match == Match::empty_and_occupied) hypotheses_.push_back({Layer::empty});
  for (Hypothesis& h : hypotheses_) h.old.resize(field.cells()), h.now.resize(field.cells());
}

double HeadingAgent::error_of(const Map& map, const scenes::Sensed& scan, const scenes::Pose& believed) {
  current_.map.clear();
  current_.fuse(scan, believed, 0);
  const CellRect& rect = field_.rect;
  const double cx = believed.x_m / field_.cell_m - static_cast<double>(rect.x),
               cy = believed.y_m / field_.cell_m - static_cast<double>(rect.y);
  for (Hypothesis& h : hypotheses_) {
    map.render(h.layer, rect, h.old, rect.width);
    current_.map.render(h.layer, rect, h.now, rect.width);
    h.around.clear();
    for (int y = 0; y < rect.height; ++y) {
      for (int x = 0; x < rect.width; ++x) {
        if (h.now[field_.index({x, y})] > kSurely) h.around.push_back({x + 0.5 - cx, y + 0.5 - cy});
      }
    }
  }
  const auto matches = [&](int k) {
    const double c = std::cos(k * kStep_rad), s = std::sin(k * kStep_rad);
    int n = 0;
    for (const Hypothesis& h : hypotheses_) {
      for (const raycast::Point& p : h.around) {
        const GridCell at{static_cast<int>(std::floor(cx + c * p.x_m - s * p.y_m)),
                          static_cast<int>(std::floor(cy + s * p.x_m + c * p.y_m))};
        n += field_.inside(at) && h.old[field_.index(at)] > kSurely ? 1 : 0;
      }
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
