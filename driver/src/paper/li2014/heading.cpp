// SPDX-License-Identifier: Apache-2.0
#include "paper/li2014/heading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace evigrid::driver {
namespace {

constexpr float kSurely = 0.8F;
constexpr int kSteps = 20;  // of 0.25 degrees on either side: eta within 5 degrees
constexpr double kStep_rad = 0.25 * std::numbers::pi / 180;
constexpr double kMargin_m = 0.5;  // beyond a sonar's range: its arc has a width

double reach_of(const scenes::Scene& robot) {
  double reach_m = 0;
  for (const scenes::SonarSpec& s : robot.sonars)
    reach_m = std::max(reach_m, s.max_range_m + std::hypot(s.T_robot_sensor.x_m, s.T_robot_sensor.y_m));
  return reach_m + kMargin_m;
}

/// What of the field lies around the robot.
FieldRect part_of(const FieldRect& field, const scenes::Pose& at, double reach_m) {
  const auto cell = [&](double m) { return static_cast<std::int64_t>(std::floor(m / field.cell_m)); };
  const CellRect& f = field.rect;
  FieldRect out = field;
  out.rect.x = std::clamp(cell(at.x_m - reach_m), f.x, f.x + f.width);
  out.rect.y = std::clamp(cell(at.y_m - reach_m), f.y, f.y + f.height);
  out.rect.width = std::clamp(cell(at.x_m + reach_m) + 1, f.x, f.x + f.width) - out.rect.x;
  out.rect.height = std::clamp(cell(at.y_m + reach_m) + 1, f.y, f.y + f.height) - out.rect.y;
  return out;
}

}  // namespace

HeadingAgent::HeadingAgent(const scenes::Scene& robot, const MapParams& params, const FieldRect& field,
                           std::shared_ptr<Executor> executor, double least_gain, Match match)
    : field_(field), current_(robot, params, std::move(executor)), reach_m_(reach_of(robot)), least_gain_(least_gain) {
  hypotheses_.push_back({Layer::bel});
  if (match == Match::empty_and_occupied) hypotheses_.push_back({Layer::empty});
}

double HeadingAgent::error_of(const Map& map, const scenes::Sensed& scan, const scenes::Pose& believed) {
  current_.map.clear();
  current_.fuse(scan, believed, 0);
  const FieldRect part = part_of(field_, believed, reach_m_);
  const CellRect& rect = part.rect;
  if (part.cells() == 0) return 0;  // a robot that believes to be elsewhere
  const double cx = believed.x_m / part.cell_m - static_cast<double>(rect.x),
               cy = believed.y_m / part.cell_m - static_cast<double>(rect.y);
  for (Hypothesis& h : hypotheses_) {
    h.old.resize(part.cells()), h.now.resize(part.cells());
    map.render(h.layer, rect, h.old, rect.width);
    current_.map.render(h.layer, rect, h.now, rect.width);
    h.around.clear();
    for (int y = 0; y < rect.height; ++y) {
      for (int x = 0; x < rect.width; ++x) {
        if (h.now[part.index({x, y})] > kSurely) h.around.push_back({x + 0.5 - cx, y + 0.5 - cy});
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
        n += part.inside(at) && h.old[part.index(at)] > kSurely ? 1 : 0;
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
