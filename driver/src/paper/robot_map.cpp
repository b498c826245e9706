// SPDX-License-Identifier: Apache-2.0
#include "paper/robot_map.hpp"

#include <cmath>

#include "cycle/fleet_options.hpp"

namespace evigrid::driver {

RobotMap::RobotMap(const scenes::Scene& robot, const MapParams& params, std::shared_ptr<Executor> executor)
    : map(params, std::move(executor)), sonars_(robot.sonars.size()) {
  for (const Sensor& s : sensors_of(robot)) {
    ids_.push_back(map.add(s));
    beams_.push_back(static_cast<std::size_t>(s.beams));
  }
}

Report RobotMap::fuse(const scenes::Sensed& sensed, const scenes::Pose& pose, double time_s) {
  std::vector<Reading> readings;
  std::size_t beam = 0;
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    if (i < sonars_) {
      readings.push_back({ids_[i], {&sensed.ranges_m[i], 1}});
    } else {
      readings.push_back({ids_[i], std::span(sensed.beams_m).subspan(beam, beams_[i])});
      beam += beams_[i];
    }
  }
  return map.integrate(Scan{std::llround(time_s * 1e9), to_engine(pose), readings});
}

}  // namespace evigrid::driver
