// SPDX-License-Identifier: Apache-2.0
// The localization agent (Li et al. 2014, "Method for self-localization"): the cells that the newest scan alone holds
// for occupied are turned about the robot by eta; the eta with most of them on cells that the map holds for occupied is
// the error of the heading.
//
// Ours: eta must have a twentieth more matches than no turn at all. The model's walls begin 0.1 R^1.5 / (0.35 R^0.5 +
// 0.1) before the reading, so what lies ahead is thicker in the map than in the scan, and the count leans by a degree
// or two to the side of the nearer wall: corrected in every cycle without that bound, the heading runs away even when
// the wheels are perfect.
#pragma once
#include "evigrid/scenes/live.hpp"
#include "paper/li2014/field.hpp"
#include "paper/robot_map.hpp"

namespace evigrid::driver {

class HeadingAgent {
 public:
  /// @param least_gain share of matches that eta must have more than no turn; 0: the paper's method to the letter.
  HeadingAgent(const scenes::Scene& robot, const MapParams& params, const FieldRect& field,
               std::shared_ptr<Executor> executor, double least_gain = 0.05);
  /// @param map what was known before this scan.
  /// @return eta within 5 degrees, rad, to be added to the heading that is believed; 0 when nothing matches better.
  [[nodiscard]] double error_of(const Map& map, const scenes::Sensed& scan, const scenes::Pose& believed);

 private:
  FieldRect field_;
  RobotMap current_;
  double reach_m_;  // from the robot's centre to the farthest cell that a scan can tell of
  double least_gain_;
  std::vector<float> old_, now_;
};

}  // namespace evigrid::driver
