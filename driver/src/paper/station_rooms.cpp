// SPDX-License-Identifier: Apache-2.0
#include "paper/station_rooms.hpp"

#include <algorithm>
#include <cmath>

#include "paper/cluttered_room.hpp"
#include "progress.hpp"

namespace evigrid::driver {
namespace {

constexpr double kFewestCells = 1100;  // section 4
constexpr raycast::Point kMiddle{5, 5};

}  // namespace

Experiment experiment(const PaperWorld& room, raycast::Point first, std::size_t count, const StationOptions& options,
                      const After& after_of_first) {
  const std::uint64_t seed = room.scene.trajectory.seed;
  Experiment e;
  const StationRun scout = move_to_station(room, {first.x_m, first.y_m, 0}, seed, options);
  e.from = starts_around(room, scout.end(), count, seed);
  Progress progress("moving to station");
  for (std::size_t i = 0; i < count; ++i) {
    e.runs.push_back(move_to_station(room, e.from[i], seed + 1 + i, options, i == 0 ? after_of_first : After{}));
    e.least_cells = std::min(e.least_cells, e.runs.back().least_cells);
    progress.show(i + 1, count);
  }
  e.spread = spread(e.runs, enclosing_centre(e.runs));
  return e;
}

PaperWorld drawn_room(const PaperOptions& o, std::uint64_t number) {
  scenes::Scene scene = paper_scene({.seed = o.seed}, "hughes1992", "hughes24");
  scene.world = cluttered_room(number, kFree_m);
  scene.trajectory.waypoints = {kMiddle, {kMiddle.x_m + 0.1, kMiddle.y_m}};
  return PaperWorld(std::move(scene));
}

bool as_published(const Experiment& e) {
  return e.spread.within == e.runs.size() && e.spread.settled == e.runs.size() &&
         e.spread.most_moves <= kPublishedMoves;
}

Rooms drawn_rooms(const PaperOptions& o, std::size_t rooms, std::size_t runs) {
  Rooms out;
  const auto off = [](const Experiment& e) { return std::abs(static_cast<double>(e.least_cells) - kFewestCells); };
  for (std::size_t k = 0; k < rooms; ++k) {
    out.all.push_back(experiment(drawn_room(o, k + 1), kMiddle, runs, {.threads = o.threads}));
    out.sound += as_published(out.all[k]);
    if (off(out.all[k]) < off(out.all[out.nearest])) out.nearest = k;
  }
  return out;
}

}  // namespace evigrid::driver
