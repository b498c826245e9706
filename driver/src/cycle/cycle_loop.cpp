// SPDX-License-Identifier: Apache-2.0
#include "cycle/cycle_loop.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "error.hpp"

namespace evigrid::driver {

std::string_view name(Policy p) noexcept {
  return p == Policy::none ? "none" : p == Policy::backlog ? "backlog" : "skip";
}

Policy parse_policy(const std::string& text) {
  for (const Policy p : {Policy::none, Policy::backlog, Policy::skip})
    if (text == name(p)) return p;
  throw InputError("--policy: '" + text + "' is unknown; known: none, backlog, skip");
}

namespace {

class Loop {
 public:
  Loop(CycleWork& work, const CycleOptions& options)
      : work_(work),
        o_(options),
        queue_(o_.policy == Policy::backlog ? std::max<std::size_t>(o_.backlog, 1)
                                            : std::numeric_limits<std::size_t>::max()),
        budget_(o_.deadline_s) {}

  CycleResult run() {
    const std::uint64_t all = o_.cycles * o_.scans_per_cycle;
    for (std::uint64_t c = 0; c < o_.cycles || result_.made < all || queue_.size() > 0; ++c) {
      const CycleRow& row = cycle(c, std::min((c + 1) * o_.scans_per_cycle, all));
      if (o_.give_up && o_.give_up(row.whole_s)) {
        result_.gave_up = true;
        break;
      }
      if (o_.wait && row.whole_s < o_.deadline_s) o_.wait(o_.deadline_s - row.whole_s);
    }
    result_.most_waiting = queue_.counts().most_waiting;
    return std::move(result_);
  }

 private:
  /// `due`: scans that the robots want to have made by the end of this cycle.
  const CycleRow& cycle(std::uint64_t number, std::uint64_t due) {
    CycleRow row;
    row.cycle = number;
    row.drain = number >= o_.cycles;
    begin_s_ = work_.now_s();
    budget_.begin_cycle();
    make(due, row);
    const double fuse_s = work_.now_s();
    if (o_.policy == Policy::none) fuse_all(row);
    if (o_.policy == Policy::backlog) fuse_backlog(row);
    if (o_.policy == Policy::skip) fuse_or_skip(row);
    const double render_s = work_.now_s();
    row.fuse_s = render_s - fuse_s;
    row.rendered = work_.render();
    const double end_s = work_.now_s();
    row.render_s = end_s - render_s;
    row.whole_s = end_s - begin_s_;
    budget_.rendered(row.render_s);
    row.backlog = queue_.size();
    result_.rows.push_back(std::move(row));
    return result_.rows.back();
  }

  /// Drives and casts what is due and has room. A robot that is held back waits; it makes the same scan later.
  void make(std::uint64_t due, CycleRow& row) {
    const std::uint64_t wanted = due - result_.made;
    row.made = std::min<std::uint64_t>(wanted, queue_.room());
    row.held_back = wanted - row.made;
    std::vector<FleetScan> scans(row.made);
    const double begin_s = work_.now_s();
    if (!scans.empty()) work_.drive(result_.made, scans);
    const double cast_s = work_.now_s();
    if (!scans.empty()) work_.cast(scans);
    row.drive_s = cast_s - begin_s;
    row.cast_s = work_.now_s() - cast_s;
    for (FleetScan& scan : scans) queue_.try_push(std::move(scan));
    result_.made += row.made;
  }

  void fuse(std::span<const FleetScan> scans, CycleRow& row) {
    row.report += work_.fuse(scans);
    row.fused += scans.size();
    result_.fused += scans.size();
  }

  void fuse_all(CycleRow& row) {
    taken_.clear();
    queue_.pop(queue_.capacity(), taken_);
    if (!taken_.empty()) fuse(taken_, row);
    for (const FleetScan& scan : taken_) work_.log(scan, true);
  }

  /// Slices from the front of the queue as long as there is time; the rest stays.
  void fuse_backlog(CycleRow& row) {
    double now_s = work_.now_s();
    while (queue_.size() > 0 && budget_.has_time(now_s - begin_s_)) {
      taken_.clear();
      queue_.pop(o_.slice, taken_);
      fuse(taken_, row);
      for (const FleetScan& scan : taken_) work_.log(scan, true);
      const double then_s = std::exchange(now_s, work_.now_s());
      budget_.fused(now_s - then_s, taken_.size());
    }
  }

  /// When more scans are there than the time will do for, some are left out evenly, in turns, so that no robot is left
  /// out for good; the clock may still cut the rest short. What is fused keeps its order.
  void fuse_or_skip(CycleRow& row) {
    taken_.clear();
    queue_.pop(queue_.capacity(), taken_);
    if (taken_.empty()) return;
    double now_s = work_.now_s();
    const std::size_t all = taken_.size(),
                      most = std::max<std::size_t>(budget_.scans_in_time(now_s - begin_s_, all), 1);
    std::vector<FleetScan> slice;
    bool in_time = true;
    for (std::size_t i = 0, chosen = row.cycle % all * most % all; i < all; ++i) {
      chosen += most;
      const bool take = chosen >= all;
      if (take) chosen -= all;
      if (!take || !in_time) {
        ++(take ? row.cut_short : row.thinned);
        work_.log(taken_[i], false);
        continue;
      }
      work_.log(taken_[i], true);
      slice.push_back(std::move(taken_[i]));
      if (slice.size() < o_.slice && i + 1 < all) continue;
      now_s = fuse_slice(slice, now_s, row);
      in_time = budget_.has_time(now_s - begin_s_);
    }
    if (!slice.empty()) fuse_slice(slice, now_s, row);
    result_.thinned += row.thinned;
    result_.cut_short += row.cut_short;
  }

  double fuse_slice(std::vector<FleetScan>& slice, double begin_s, CycleRow& row) {
    fuse(slice, row);
    const double end_s = work_.now_s();
    budget_.fused(end_s - begin_s, slice.size());
    slice.clear();
    return end_s;
  }

  CycleWork& work_;
  const CycleOptions& o_;
  BoundedQueue<FleetScan> queue_;
  Budget budget_;
  CycleResult result_;
  std::vector<FleetScan> taken_;
  double begin_s_ = 0;
};

}  // namespace

CycleResult run_cycles(CycleWork& work, const CycleOptions& options) { return Loop(work, options).run(); }

}  // namespace evigrid::driver
