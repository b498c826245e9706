// SPDX-License-Identifier: Apache-2.0
// Where the moving objects of a scene stand at a time.
#pragma once
#include <cmath>
#include <vector>

#include "evigrid/scenes/simulate.hpp"

namespace evigrid::driver {

class Walkers {
 public:
  explicit Walkers(const scenes::Scene& scene) {
    for (const scenes::MoverSpec& m : scene.movers) {
      routes_.emplace_back(m.trajectory);
      loops_.push_back(m.loop);
    }
  }
  [[nodiscard]] std::vector<raycast::Placement> at(double time_s) const {
    std::vector<raycast::Placement> out;
    for (std::size_t i = 0; i < routes_.size(); ++i) {
      const double t = loops_[i] ? std::fmod(time_s, routes_[i].duration_s()) : time_s;
      const scenes::Pose p = routes_[i].at(t);
      out.push_back({p.x_m, p.y_m, p.yaw_rad});
    }
    return out;
  }

 private:
  std::vector<scenes::Route> routes_;
  std::vector<bool> loops_;
};

}  // namespace evigrid::driver
