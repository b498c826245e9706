// SPDX-License-Identifier: Apache-2.0
// The localization agent (Li et al. 2014, "Method for self-localization"): the cells of the newest scan alone are
// turned about the robot by eta; the eta with most matches is the error of the heading. A match is a point "whose m(θj)
// > 0.8 in the current map and at the same time m(θj) > 0.8 at the same place in the old map": j is left open, so empty
// cells match empty ones, too. With occupied ones alone the heading loses its hold now and then (report_heading.cpp).
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

enum class Match { empty_and_occupied, occupied };

class HeadingAgent {
 public:
  /// @param least_gain share of matches that eta must have more than no turn; 0: the paper's method to the letter.
  HeadingAgent(const scenes::Scene& robot, const MapParams& params, const FieldRect& field,
               std::shared_ptr<Executor> executor, double least_gain = 0.05, Match match = Match::empty_and_occupied);
  /// @param map what was known before this scan.
  /// @return eta within 5 degrees, rad, to be added to the heading that is believed; 0 when nothing matches better.
  [[nodiscard]] double error_of(const Map& map, const scenes::Sensed& scan, const scenes::Pose& believed);

 private:
  FieldRect field_;
  RobotMap current_;
  double reach_m_;  // from the robot's centre to the farthest cell that a scan can tell of
  double least_gain_;
  struct Hypothesis {
    Layer layer;
    std::vector<float> old{}, now{};
    std::vector<raycast::Point> around{};  ///< cells of the scan, from the robot's centre, in cells
  };
  std::vector<Hypothesis> hypotheses_;
};

}  // namespace evigrid::driver
