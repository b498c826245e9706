// SPDX-License-Identifier: Apache-2.0
// move-to-station from many starts in one room, and in rooms drawn at random.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "paper/move_to_station.hpp"

namespace evigrid::driver {

inline constexpr int kPublishedMoves = 5;
inline constexpr double kFree_m = 1.3;  ///< left free in drawn rooms: the starts' circle of 0.9 m, the robot and 5 cm

/// Runs from all around the expected station, which is where a first run from inside the room ends, as the authors
/// found it before their experiments.
struct Experiment {
  std::vector<scenes::Pose> from;
  std::vector<StationRun> runs;
  Spread spread{};
  std::size_t least_cells = SIZE_MAX;
};
using After = std::function<void(const Map&, const StationRun&)>;
[[nodiscard]] Experiment experiment(const PaperWorld& room, raycast::Point first, std::size_t count,
                                    const StationOptions& options, const After& after_of_first = {});
/// Every run within kStation_m and settled within five moves.
[[nodiscard]] bool as_published(const Experiment& e);

/// Rooms drawn at random, and the one whose fewest cells come nearest to the published number: the paper's room for
/// all that we know of it.
struct Rooms {
  std::vector<Experiment> all;
  std::size_t nearest = 0, sound = 0;  ///< sound: as_published()
};
[[nodiscard]] Rooms drawn_rooms(const PaperOptions& options, std::size_t rooms, std::size_t runs);
[[nodiscard]] PaperWorld drawn_room(const PaperOptions& options, std::uint64_t number);

}  // namespace evigrid::driver
