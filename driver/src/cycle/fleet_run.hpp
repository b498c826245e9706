// SPDX-License-Identifier: Apache-2.0
// A fleet in a generated building, cycle by cycle: the parts put together. The building is made once and serves any
// number of trials; each trial has a fleet and a map of its own.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cycle/cost_tiles.hpp"
#include "cycle/cycle_loop.hpp"
#include "cycle/fleet_options.hpp"
#include "cycle/percentiles.hpp"
#include "cycle/scan_log.hpp"
#include "evigrid/evigrid.hpp"
#include "evigrid/raycast/scene.hpp"
#include "evigrid/scenes/fleet.hpp"

namespace evigrid::driver {

struct FleetWorld {
  /// Throws InputError when the building cannot be made.
  explicit FleetWorld(const FleetOptions& options);
  double side_m, made_s = 0;
  std::size_t surfaces = 0;
  std::unique_ptr<const scenes::Floor> floor;
  std::unique_ptr<const raycast::Scene> caster;
};

struct FleetTrial {
  FleetOptions options;
  CycleResult cycles;
  Map map;
  CostTiles costs;
  std::shared_ptr<Executor> executor;
  std::vector<std::string> models;
  std::size_t ranges_per_scan = 0, sensors = 0;
  double placed_s = 0;  ///< finding a place and a first goal for every robot
  std::vector<Pose2> last_poses;

  /// The measured cycles: after the warm-up, before the drain.
  [[nodiscard]] std::vector<const CycleRow*> measured() const;
  [[nodiscard]] std::uint64_t missed() const;
  [[nodiscard]] Spread spread(double (*of)(const CycleRow&)) const;
};

struct TrialExtras {
  std::string log{};  ///< file for every scan; empty: none
  std::function<void(std::size_t done, std::size_t all)> progress{};
  bool stop_when_lost = false;  ///< ends as soon as p99 cannot keep the deadline any more
};

FleetTrial run_trial(const FleetWorld& world, const FleetOptions& options, const TrialExtras& extras = {});

/// An engine's executor as scenes know one.
scenes::Parallel parallel_on(Executor& executor);

/// Engine scans that refer to the ranges of fleet scans.
class ScanViews {
 public:
  ScanViews(const Map& map);
  std::span<const Scan> of(std::span<const FleetScan> scans);

 private:
  std::vector<std::size_t> counts_;  // ranges of each sensor
  std::vector<Reading> readings_;
  std::vector<Scan> scans_;
};

}  // namespace evigrid::driver
