// SPDX-License-Identifier: Apache-2.0
#include "cycle/fleet_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "error.hpp"
#include "evigrid/scenes/building.hpp"
#include "mapping.hpp"

namespace evigrid::driver {
namespace {

constexpr double kBorder_m = 16;  // the costmap's, around the building: farther than any cone reaches through a wall

class Work : public CycleWork {
 public:
  Work(const FleetWorld& world, const FleetPlan& plan, FleetTrial& trial, const std::string& log)
      : trial_(trial),
        executor_(*trial.executor),
        parallel_(parallel_on(executor_)),
        fleet_(*world.floor, *world.caster, plan.robot, spec_of(trial.options), parallel_),
        pages_(!trial.options.page_dir.empty()),
        views_(trial.map) {
    trial_.ranges_per_scan = fleet_.ranges_per_scan();
    if (!log.empty()) log_ = std::make_unique<ScanLogWriter>(log, trial_.map, trial_.ranges_per_scan);
  }

  /// After the last cycle.
  void finish() {
    if (log_) log_->commit();
    for (const scenes::Pose& p : poses_) trial_.last_poses.push_back({p.x_m, p.y_m, p.yaw_rad});
  }

  void drive(std::uint64_t first, std::span<FleetScan> scans) override {
    first_ = first;
    poses_.resize(scans.size());
    fleet_.drive(first, poses_, parallel_);
  }

  void cast(std::span<FleetScan> scans) override {
    const std::size_t ranges = fleet_.ranges_per_scan();
    ranges_m_.resize(scans.size() * ranges);
    fleet_.measure(first_, poses_, ranges_m_, parallel_);
    for (std::size_t i = 0; i < scans.size(); ++i) {
      FleetScan& scan = scans[i];
      scan.number = first_ + i;
      scan.stamp_ns = fleet_.stamp_ns(scan.number);
      scan.robot = static_cast<std::uint32_t>(scan.number % fleet_.robots());
      scan.T_map_robot = {poses_[i].x_m, poses_[i].y_m, poses_[i].yaw_rad};
      const float* begin = ranges_m_.data() + i * ranges;
      scan.ranges_m.assign(begin, begin + ranges);
    }
  }

  Report fuse(std::span<const FleetScan> scans) override {
    try {
      return integrate_what_fits(trial_.map, views_.of(scans), pages_);
    } catch (const std::length_error& full) {
      throw InputError(
          fmt::format("--memory-mb: {}; fewer --robots or --cycles need less, --page-dir takes more", full.what()));
    } catch (const std::system_error& disk) {
      throw InputError(fmt::format("--page-dir: {}", disk.what()));
    }
  }

  Rendered render() override { return trial_.costs.update(trial_.map, executor_); }
  void log(const FleetScan& scan, bool fused) override {
    if (log_) log_->add(scan, fused);
  }
  double now_s() override { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

 private:
  static scenes::FleetSpec spec_of(const FleetOptions& o) {
    scenes::FleetSpec spec;
    spec.robots = static_cast<std::size_t>(o.robots);
    spec.seed = static_cast<std::uint64_t>(o.seed);
    spec.period_s = o.deadline_ms / 1000 / static_cast<double>(o.scans);
    spec.speed_m_s = o.speed_m_s;
    return spec;
  }

  FleetTrial& trial_;
  Executor& executor_;
  scenes::Parallel parallel_;
  scenes::Fleet fleet_;
  bool pages_;
  ScanViews views_;
  std::unique_ptr<ScanLogWriter> log_;
  std::uint64_t first_ = 0;
  std::vector<scenes::Pose> poses_;
  std::vector<float> ranges_m_;
};

Map map_of(const FleetPlan& plan, std::vector<std::string>& models) {
  Map map(plan.params, plan.executor);
  page_to(map, plan.page_dir);
  for (const Sensor& s : sensors_of(plan.robot)) {
    try {
      map.add(s);
    } catch (const std::invalid_argument& bad) {  // what only map and sensor together can tell: the reach in cells
      throw InputError(bad.what());
    }
    const std::string model(name(s.model));
    if (std::find(models.begin(), models.end(), model) == models.end()) models.push_back(model);
  }
  return map;
}

}  // namespace

scenes::Parallel parallel_on(Executor& executor) {
  return [&executor](std::size_t count, const std::function<void(std::size_t)>& work) {
    auto& shared = const_cast<std::function<void(std::size_t)>&>(work);  // an executor's context is not const
    executor.run(
        static_cast<std::int64_t>(count),
        [](void* context, std::int64_t i, int) {
          (*static_cast<const std::function<void(std::size_t)>*>(context))(static_cast<std::size_t>(i));
        },
        &shared);
  };
}

ScanViews::ScanViews(const Map& map) {
  for (const Sensor& s : map.sensors()) counts_.push_back(static_cast<std::size_t>(s.beams));
}

std::span<const Scan> ScanViews::of(std::span<const FleetScan> scans) {
  readings_.clear();
  readings_.reserve(scans.size() * counts_.size());
  scans_.clear();
  for (const FleetScan& scan : scans) {
    const std::size_t first = readings_.size();
    std::span<const float> rest = scan.ranges_m;
    for (SensorId id = 0; id < counts_.size(); ++id) {
      readings_.push_back({id, rest.first(counts_[id])});
      rest = rest.subspan(counts_[id]);
    }
    scans_.push_back({scan.stamp_ns, scan.T_map_robot, std::span<const Reading>(readings_).subspan(first)});
  }
  return scans_;
}

FleetWorld::FleetWorld(const FleetOptions& o) : side_m(static_cast<double>(o.grid) * o.cell_m) {
  const auto start = Clock::now();
  scenes::BuildingSpec building;
  building.width_m = building.depth_m = side_m;
  building.seed = static_cast<std::uint64_t>(o.seed);
  building.room_m = o.room_m;
  try {
    const raycast::World walls = scenes::make_building(building);
    floor = std::make_unique<scenes::Floor>(walls);
    caster = std::make_unique<raycast::Scene>(walls);
  } catch (const std::invalid_argument& bad) {
    throw InputError(fmt::format("--grid {} of {} m cells: {}", o.grid, o.cell_m, bad.what()));
  }
  surfaces = caster->surface_count();
  made_s = seconds_since(start);
}

std::vector<const CycleRow*> FleetTrial::measured() const {
  std::vector<const CycleRow*> out;
  for (const CycleRow& row : cycles.rows)
    if (!row.drain && row.cycle >= static_cast<std::uint64_t>(options.warmup)) out.push_back(&row);
  return out;
}

std::uint64_t FleetTrial::missed() const {
  std::uint64_t n = 0;
  for (const CycleRow* row : measured()) n += row->whole_s * 1000 > options.deadline_ms ? 1 : 0;
  return n;
}

Spread FleetTrial::spread(double (*of)(const CycleRow&)) const {
  std::vector<double> values;
  for (const CycleRow* row : measured()) values.push_back(of(*row));
  return spread_of(std::move(values));
}

FleetTrial run_trial(const FleetWorld& world, const FleetOptions& o, const TrialExtras& extras) {
  const FleetPlan plan = plan_fleet(o);
  std::vector<std::string> models;
  Map map = map_of(plan, models);
  const std::size_t sensors = map.sensors().size();
  FleetTrial trial{o,
                   {},
                   std::move(map),
                   CostTiles(o.grid, static_cast<std::int64_t>(kBorder_m / o.cell_m)),
                   plan.executor,
                   std::move(models),
                   0,
                   sensors,
                   0,
                   {}};
  const auto start = Clock::now();
  std::unique_ptr<Work> work;
  try {
    work = std::make_unique<Work>(world, plan, trial, extras.log);
  } catch (const std::invalid_argument& bad) {
    throw InputError(fmt::format("--robot {}: {}", o.robot, bad.what()));
  }
  trial.placed_s = seconds_since(start);
  CycleOptions cycles;
  cycles.scans_per_cycle = static_cast<std::uint64_t>(o.robots * o.scans);
  cycles.cycles = static_cast<std::uint64_t>(o.warmup + o.cycles);
  cycles.deadline_s = o.deadline_ms / 1000;
  cycles.policy = plan.policy;
  cycles.backlog = static_cast<std::size_t>(o.backlog > 0 ? o.backlog : 2 * o.robots * o.scans);
  cycles.slice = static_cast<std::size_t>(o.slice);
  if (o.paced) cycles.wait = [](double s) { std::this_thread::sleep_for(std::chrono::duration<double>(s)); };
  std::size_t done = 0, above = 0;
  const std::size_t allowed = allowed_above(99, static_cast<std::size_t>(o.cycles));
  cycles.give_up = [&](double took_s) {
    if (++done > static_cast<std::size_t>(o.warmup) && took_s >= cycles.deadline_s) ++above;
    if (extras.progress) extras.progress(done, cycles.cycles);
    return extras.stop_when_lost && above > allowed;
  };
  trial.cycles = run_cycles(*work, cycles);
  work->finish();
  return trial;
}

}  // namespace evigrid::driver
