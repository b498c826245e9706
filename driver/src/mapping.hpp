// SPDX-License-Identifier: Apache-2.0
// From a log, recorded or simulated, to a map and its output folder: what `map` and `run` share.
#pragma once
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "evigrid/evigrid.hpp"
#include "log/log.hpp"
#include "options.hpp"
#include "out/layers.hpp"
#include "out/out_dir.hpp"

namespace evigrid::driver {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start);

/// Everything about the options that can be wrong before any file is read: throws InputError.
struct Plan {
  MapParams params;
  std::shared_ptr<Executor> executor;
};
Plan make_plan(const MappingOptions& options);

struct Fused {
  Map map;
  Report report;
  double fusion_s = 0;  ///< the engine's time alone
  std::vector<std::string> models;
  std::shared_ptr<Executor> executor;
  nlohmann::ordered_json journal = {};  ///< what became of it; null without one
};

/// The sensor as the map will use it: the log's geometry with the user's model, range and reliability. `mixed`: the log
/// has lasers and sonars, and a model is meant for those that it fits.
Sensor configured(const LogSensor& from_log, const MappingOptions& options, bool mixed);
bool holds_both_kinds(const Log& log);

/// A journal of what is fused (evigrid/journal.hpp), or none.
struct JournalFile {
  std::string path;     ///< empty: none
  bool resume = false;  ///< goes on with the one that is there
};
/// Throws InputError also when a journal to go on with is of other sensors, parameters or scans than the log.
/// Throws InputError for a log that is no drive in the plane.
void require_plane(const Log& log, const std::string& named);
/// As many scans at once as fit under the map's cap, where tiles can go elsewhere between two of them. Throws
/// std::length_error when one does not.
Report integrate_what_fits(Map& map, std::span<const Scan> scans, bool pages);
Fused fuse(const Log& log, const MappingOptions& options, Plan plan, const JournalFile& journal = {});

/// report.json, masses.npy, map.pgm, map.yaml, map.png, map.evigrid and what the options add: staged in `out` and
/// committed together. `layers` are the map's; `extra` is merged into the report.
void write_results(OutDir& out, const Log& log, const Fused& fused, const Layers& layers, const MappingOptions& options,
                   Clock::time_point start, const nlohmann::ordered_json& extra);

}  // namespace evigrid::driver
