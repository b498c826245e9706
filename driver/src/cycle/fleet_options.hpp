// SPDX-License-Identifier: Apache-2.0
// What `evigrid cycle` was asked for, and its check.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cycle/policy.hpp"
#include "evigrid/executor.hpp"
#include "evigrid/map.hpp"
#include "evigrid/scenes/scene.hpp"

namespace evigrid::driver {

struct FleetOptions {
  std::int64_t robots = 100;
  std::int64_t grid = 4096;  ///< the building's side in cells
  double cell_m = 0.05;
  double deadline_ms = 100;
  std::int64_t cycles = 100, warmup = 10;  ///< measured ones; those before them
  std::int64_t scans = 1;                  ///< of each robot in a cycle
  std::int64_t seed = 1;
  double room_m = 5, speed_m_s = 0.5;
  std::string robot = "hughes24";
  std::int64_t sensors = 0;  ///< 0: the robot's own
  std::string rule = "dempster", model;
  std::optional<double> max_range_m, reliability;
  std::string policy = "none";
  std::int64_t backlog = 0;  ///< 0: two cycles' scans
  std::int64_t slice = 64;
  bool paced = false;
  bool find_max = false;
  std::int64_t most_robots = 100000;
  std::vector<std::string> sweeps;
  std::string log, replay, part = "all";
  bool save_map = false;
  std::int64_t memory_mb = 8192;  ///< of the map
  std::string page_dir;           ///< where cold tiles go beyond it; empty: nowhere
  int threads = 0;
  std::string executor = "tbb", kernel = "auto";
  std::string out_dir, json;
};

/// The options in the words of engine and scenes.
struct FleetPlan {
  MapParams params;
  std::string page_dir;
  std::shared_ptr<Executor> executor;
  Policy policy = Policy::none;
  scenes::Scene robot;  ///< its radius and sensors, as changed by the options
};

/// Throws InputError naming the option, its value and what it may be.
[[nodiscard]] FleetPlan plan_fleet(const FleetOptions& options);

/// The sensors of a robot in the engine's words, in the order of a scan's ranges.
[[nodiscard]] std::vector<Sensor> sensors_of(const scenes::Scene& robot);

/// "robots=100,200": what to vary and its values.
struct Sweep {
  std::string what;
  std::vector<double> values;
};
[[nodiscard]] std::vector<Sweep> parse_sweeps(const std::vector<std::string>& texts);
/// The options with one of them changed.
[[nodiscard]] FleetOptions with(FleetOptions options, const std::string& what, double value);

}  // namespace evigrid::driver
