// SPDX-License-Identifier: Apache-2.0
// The loop of cycles: drive, cast, fuse, render, each timed, with one of three policies when time runs out. What the
// stages do and what time it is come from outside, so that tests run on a clock of their own.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "evigrid/bounded_queue.hpp"
#include "cycle/budget.hpp"
#include "cycle/fleet_scan.hpp"
#include "cycle/policy.hpp"
#include "evigrid/scan.hpp"

namespace evigrid::driver {

struct Rendered {
  std::uint64_t tiles = 0, cells = 0;
};

/// The stages of a cycle.
class CycleWork {
 public:
  virtual ~CycleWork() = default;
  /// Poses of scans first, first + 1, …: `scans` has the right length. Called with consecutive scans.
  virtual void drive(std::uint64_t first, std::span<FleetScan> scans) = 0;
  virtual void cast(std::span<FleetScan> scans) = 0;
  virtual Report fuse(std::span<const FleetScan> scans) = 0;  ///< in their order
  virtual Rendered render() = 0;                              ///< what changed since the last call
  virtual void log(const FleetScan& scan, bool fused) = 0;    ///< every scan once, in its order
  virtual double now_s() = 0;
};

struct CycleOptions {
  std::uint64_t scans_per_cycle = 0;
  std::uint64_t cycles = 0;
  double deadline_s = 0.1;
  Policy policy = Policy::none;
  std::size_t backlog = 0;                ///< capacity in scans, for Policy::backlog
  std::size_t slice = 64;                 ///< scans fused between two looks at the clock
  std::function<void(double)> wait{};     ///< when given: sleeps out what is left of a cycle, as a paced robot does
  std::function<bool(double)> give_up{};  ///< asked with the time of each cycle; true ends the run early
};

struct CycleRow {
  std::uint64_t cycle = 0;
  bool drain = false;  ///< after the last regular cycle: the backlog is worked off
  double drive_s = 0, cast_s = 0, fuse_s = 0, render_s = 0, whole_s = 0;
  std::uint64_t made = 0, fused = 0;         ///< scans
  std::uint64_t held_back = 0;               ///< due by now, but the full queue did not let them in
  std::uint64_t backlog = 0;                 ///< waiting at the end
  std::uint64_t thinned = 0, cut_short = 0;  ///< skipped: too many were to be expected; the time was up
  Report report;
  Rendered rendered;
};

struct CycleResult {
  std::vector<CycleRow> rows;
  std::uint64_t made = 0, fused = 0, thinned = 0, cut_short = 0;
  std::size_t most_waiting = 0;  ///< scans in the queue
  bool gave_up = false;
};

CycleResult run_cycles(CycleWork& work, const CycleOptions& options);

}  // namespace evigrid::driver
