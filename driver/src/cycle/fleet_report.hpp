// SPDX-License-Identifier: Apache-2.0
// What a trial of a fleet comes to: as text for a person, as JSON and CSV for programs, as pictures.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "cycle/fleet_run.hpp"
#include "picture/canvas.hpp"

namespace evigrid::driver {

/// The stages of a cycle, and the whole: what is timed.
struct StageRow {
  const char* name;
  double CycleRow::*seconds;
};
std::span<const StageRow> stage_rows() noexcept;

/// Cells that the paper of 2014 updates in a cycle: what fleets are counted in.
inline constexpr double kCells2014 = 50'000;

[[nodiscard]] std::string fleet_text(const FleetTrial& trial, const FleetWorld& world,
                                     const nlohmann::ordered_json& report);
/// Everything but the rows. `hash`: also of the whole map, which takes a while for a large one.
[[nodiscard]] nlohmann::ordered_json fleet_json(const FleetTrial& trial, const FleetWorld& world, bool hash);
[[nodiscard]] nlohmann::ordered_json rows_json(const FleetTrial& trial);
[[nodiscard]] std::string rows_csv(const FleetTrial& trial);

/// Cycle times over the run.
[[nodiscard]] Canvas draw_cycles(const FleetTrial& trial);
/// What the consumer holds at the end, with the robots on it.
[[nodiscard]] Canvas draw_fleet(const FleetTrial& trial);

struct SweepPoint {
  double value = 0;
  nlohmann::ordered_json report;
};
/// Cycle times against what was varied.
[[nodiscard]] Canvas draw_sweep(const std::string& what, const std::vector<SweepPoint>& points, double deadline_ms);

}  // namespace evigrid::driver
