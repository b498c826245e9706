// SPDX-License-Identifier: Apache-2.0
// The stages of a cycle with a real map, readings of our own making and a clock that only moves when we say so.
#pragma once
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "cycle/cycle_loop.hpp"
#include "cycle/fleet_run.hpp"
#include "cycle/scan_log.hpp"
#include "evigrid/evigrid.hpp"

namespace evigrid::driver {

/// What the stages take, in seconds.
struct Costs {
  double drive_s = 1e-5, cast_s = 1e-4, fuse_s = 1e-3, render_s = 2e-4;  // of each scan; rendering: of each fused scan
};

inline Map fake_map(const std::string& executor, int threads) {
  Map map({.cell_m = 0.1, .rule = Rule::pcr5}, std::shared_ptr<Executor>(make_executor(executor, threads)));
  for (int i = 0; i < 3; ++i) {
    Sensor s;
    s.aperture_rad = 0.4;
    s.T_robot_sensor = {0.1, 0, 2.0 * i};
    map.add(s);
  }
  return map;
}

class FakeFleet : public CycleWork {
 public:
  static constexpr std::uint64_t kRobots = 12;

  explicit FakeFleet(Map m, Costs c = {}) : map(std::move(m)), costs(c), views_(map) {}

  void drive(std::uint64_t first, std::span<FleetScan> scans) override {
    for (std::size_t i = 0; i < scans.size(); ++i) {
      FleetScan& s = scans[i];
      s.number = first + i;
      s.robot = static_cast<std::uint32_t>(s.number % kRobots);
      const double step = static_cast<double>(s.number / kRobots);
      s.stamp_ns = static_cast<std::int64_t>(step * 1e8);
      s.T_map_robot = {s.robot * 0.7 + 0.1 * step, std::sin(s.robot + step), 0.3 * step + s.robot};
    }
    now += costs.drive_s * static_cast<double>(scans.size());
  }
  void cast(std::span<FleetScan> scans) override {
    for (FleetScan& s : scans) {
      for (std::uint32_t i = 0; i < 3; ++i) {
        const double gauss = raycast::gaussian({5, s.robot, i, s.number});
        s.ranges_m.push_back(gauss > 1.5 ? std::numeric_limits<float>::infinity()
                                         : static_cast<float>(2 + 0.8 * gauss));
      }
    }
    now += costs.cast_s * static_cast<double>(scans.size());
  }
  Report fuse(std::span<const FleetScan> scans) override {
    for (const FleetScan& s : scans) fused.push_back(s.number);
    since_render_ += scans.size();
    now += costs.fuse_s * static_cast<double>(scans.size());
    return map.integrate(views_.of(scans));
  }
  Rendered render() override {
    now += costs.render_s * static_cast<double>(since_render_);
    since_render_ = 0;
    return {1, 1};
  }
  void log(const FleetScan& scan, bool was_fused) override {
    logged.emplace_back(scan.number, was_fused);
    if (file) file->add(scan, was_fused);
  }
  double now_s() override { return now; }

  Map map;
  Costs costs;
  double now = 1000;
  std::vector<std::uint64_t> fused;
  std::vector<std::pair<std::uint64_t, bool>> logged;
  std::unique_ptr<ScanLogWriter> file;

 private:
  ScanViews views_;
  std::size_t since_render_ = 0;
};

inline CycleOptions fake_options(Policy policy) {
  CycleOptions o;
  o.scans_per_cycle = FakeFleet::kRobots;
  o.cycles = 25;
  o.deadline_s = 0.01;  // 12 scans of 1 ms do not fit
  o.policy = policy;
  o.backlog = 30;
  o.slice = 3;
  return o;
}

}  // namespace evigrid::driver
