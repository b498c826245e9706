// SPDX-License-Identifier: Apache-2.0
#include "paper/robot_map.hpp"

#include <cmath>

#include "cycle/fleet_options.hpp"
#include "error.hpp"

namespace evigrid::driver {

RobotMap::RobotMap(const scenes::Scene& robot, const MapParams& params, std::shared_ptr<Executor> executor,
                   NoEcho no_echo)
    : map(params, std::move(executor)), sonars_(robot.sonars.size()) {
  for (const Sensor& s : sensors_of(robot)) {
    ids_.push_back(map.add(s));
    beams_.push_back(static_cast<std::size_t>(s.beams));
    full_m_.push_back(static_cast<float>(s.max_range_m));
  }
  if (no_echo == NoEcho::nothing) return;
  for (Sensor s : sensors_of(robot)) {
    if (silent_.size() == sonars_) break;  // lasers come after the sonars
    if (s.model != Model::hughes1992) throw InputError("no echo as an empty cone: is for the model hughes1992");
    s.hughes.max_occupied = 0;
    silent_.push_back(map.add(s));
  }
}

Report RobotMap::fuse(const scenes::Sensed& sensed, const scenes::Pose& pose, double time_s) {
  std::vector<Reading> readings;
  std::size_t beam = 0;
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    if (i < silent_.size() && sensed.ranges_m[i] == INFINITY) {
      readings.push_back({silent_[i], {&full_m_[i], 1}});
    } else if (i < sonars_) {
      readings.push_back({ids_[i], {&sensed.ranges_m[i], 1}});
    } else {
      readings.push_back({ids_[i], std::span(sensed.beams_m).subspan(beam, beams_[i])});
      beam += beams_[i];
    }
  }
  return map.integrate(Scan{std::llround(time_s * 1e9), to_engine(pose), readings});
}

}  // namespace evigrid::driver
