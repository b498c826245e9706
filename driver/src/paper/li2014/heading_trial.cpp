// SPDX-License-Identifier: Apache-2.0
#include "paper/li2014/heading_trial.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "evigrid/raycast/noise.hpp"
#include "mapping.hpp"
#include "options.hpp"
#include "paper/li2014/germ_robot.hpp"
#include "paper/li2014/heading.hpp"

namespace evigrid::driver {
namespace {

/// b as seen from a.
scenes::Pose between(const scenes::Pose& a, const scenes::Pose& b) {
  const double c = std::cos(a.yaw_rad), s = std::sin(a.yaw_rad), dx = b.x_m - a.x_m, dy = b.y_m - a.y_m;
  return {c * dx + s * dy, -s * dx + c * dy, b.yaw_rad - a.yaw_rad};
}

}  // namespace

HeadingTrial::HeadingTrial(const PaperWorld& world, std::uint64_t seed, bool drifts, std::size_t most_scans,
                           int threads)
    : scene_(world.scene), threads_(threads) {
  scene_.trajectory.seed = seed;
  if (drifts) {
    slips_.most_rad = 0;
  } else {
    scene_.odometry.drift_left = scene_.odometry.drift_right = 0;
  }
  const scenes::Simulation simulation(scene_, *world.caster);
  steps_ = simulation.run(0, std::min(most_scans, simulation.steps()), threads);
}

Replay HeadingTrial::replay(double least_gain, Match match) const {
  const FieldRect field = field_of(scene_, 100);  // a drifting map leaves the room
  const auto executor = parse_executor("tbb", threads_);
  const MapParams params = germ_params(scene_);
  RobotMap mapped(scene_, params, executor);
  HeadingAgent localization(scene_, params, field, executor, std::max(least_gain, 0.0), match);
  Replay out;
  scenes::Pose at = steps_.front().T_odom_robot;
  double way_m = 0;
  std::uint64_t slipped = 0;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const scenes::Step& now = steps_[i];
    if (i > 0) {
      const scenes::Pose moved = between(steps_[i - 1].T_odom_robot, now.T_odom_robot);
      at = compose(at, moved);
      way_m += std::hypot(moved.x_m, moved.y_m);
    }
    while (way_m >= slips_.every_m * static_cast<double>(slipped + 1)) {
      const std::uint64_t bits = raycast::random_bits({scene_.trajectory.seed, 1, 0, slipped++}, 0);
      at.yaw_rad += slips_.most_rad * static_cast<double>(bits >> 11) * 0x1p-53;
    }
    const scenes::Sensed scan{now.ranges_m, {}};
    const auto begin = Clock::now();
    if (least_gain >= 0 && i > 0) at.yaw_rad += localization.error_of(mapped.map, scan, at);
    mapped.fuse(scan, at, static_cast<double>(now.stamp_ns) * 1e-9);
    out.most_cycle_ms = std::max(out.most_cycle_ms, 1e3 * seconds_since(begin));
    const scenes::Pose& is = now.T_map_robot;
    out.believed.push_back(to_engine(at));
    out.error_m.push_back(std::hypot(at.x_m - is.x_m, at.y_m - is.y_m));
    out.error_rad.push_back(std::remainder(at.yaw_rad - is.yaw_rad, 2 * std::numbers::pi));
  }
  out.layers = render_layers(mapped.map, field.rect, "map", 512);
  return out;
}

}  // namespace evigrid::driver
