// SPDX-License-Identifier: Apache-2.0
// Li et al. 2014, "SLAM experiments": a room with two small things that stand, A and B, and a person who walks all the
// time, mapped from the same readings by several rules. What each map says of A, of B, of the person where it stands
// and of the places that it left.
#pragma once
#include <string>
#include <vector>

#include "out/layers.hpp"
#include "paper/paper_world.hpp"
#include "score/score.hpp"

namespace evigrid::driver {

struct RoomMapping {
  Rule rule = Rule::germ_pcr2;
  double reliability = 1;  ///< of every reading: Shafer's discount, the reliability floor
  [[nodiscard]] std::string name() const;
};

struct RoomResult {
  RoomMapping mapping;
  std::vector<double> object_shown;  ///< of each box: share of its outline with a cell called occupied within 5 cm
  std::size_t person_seen = 0;       ///< scans with an echo of the person
  std::size_t person_shown = 0;      ///< of those: a cell called occupied within 5 cm of the leg that gave the echo
  std::size_t left = 0;              ///< cells once called occupied for the person, which has long gone from there
  std::size_t left_empty = 0, left_occupied = 0;  ///< what they are called at the end; the rest: unknown
  double most_cycle_ms = 0, mean_cycle_ms = 0;    ///< fusion of one scan
  std::uint64_t most_cells = 0;                   ///< updated in one scan
  Layers layers, halfway;                         ///< at the end, and while the person is in sight of the robot
  Score score;
};

struct RoomRun {
  std::vector<Pose2> way;               ///< true poses, one a scan
  raycast::Placement person_halfway{};  ///< where it stood at RoomResult::halfway
  std::vector<RoomResult> results;      ///< one a mapping
};

/// @param world with one mover, the person, of circles.
[[nodiscard]] RoomRun map_dynamic_room(const PaperWorld& world, const std::vector<RoomMapping>& mappings, bool quick,
                                       int threads);

}  // namespace evigrid::driver
