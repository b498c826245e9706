// SPDX-License-Identifier: Apache-2.0
#include "cycle/fleet_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>

#include <algorithm>

#include "evigrid/combine.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::ordered_json;

constexpr StageRow kStages[] = {{"drive", &CycleRow::drive_s},
                                {"cast", &CycleRow::cast_s},
                                {"fuse", &CycleRow::fuse_s},
                                {"render", &CycleRow::render_s},
                                {"whole", &CycleRow::whole_s}};

Json to_json(const Spread& s, double scale = 1) {
  return {{"p50", s.p50 * scale},
          {"p95", s.p95 * scale},
          {"p99", s.p99 * scale},
          {"max", s.max * scale},
          {"mean", s.mean * scale}};
}

double readings(const CycleRow& r) { return static_cast<double>(r.report.readings_used + r.report.refused_total()); }
double cells(const CycleRow& r) { return static_cast<double>(r.report.cells_updated); }

Spread stage_spread(const FleetTrial& trial, const StageRow& stage) {
  std::vector<double> values;
  for (const CycleRow* row : trial.measured()) values.push_back(row->*stage.seconds);
  return spread_of(std::move(values));
}

Report total_of(const FleetTrial& trial) {
  Report total;
  for (const CycleRow& row : trial.cycles.rows) total += row.report;
  return total;
}

Json refused(const Report& report) {
  Json out = Json::object();
  for (int i = 0; i < kRefusalCount; ++i)
    if (const auto n = report.refused[static_cast<std::size_t>(i)]; n > 0)
      out[std::string(name(static_cast<Refusal>(i)))] = n;
  return out;
}

std::size_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

void add_scans(Json& r, const FleetTrial& trial) {
  const CycleResult& c = trial.cycles;
  std::uint64_t held = 0, drain = 0, missed = 0;
  for (const CycleRow& row : c.rows) {
    held += row.held_back;
    drain += row.drain ? 1 : 0;
    missed += row.drain && row.whole_s * 1000 > trial.options.deadline_ms ? 1 : 0;
  }
  r["missed_cycles"] = trial.missed();
  r["drain_cycles"] = drain;
  r["drain_cycles_missed"] = missed;
  r["scans_made"] = c.made;
  r["scans_fused"] = c.fused;
  r["scans_skipped"] = {{"thinned", c.thinned}, {"cut_short", c.cut_short}};
  r["scans_held_back"] = held;
  r["most_scans_waiting"] = c.most_waiting;
}

}  // namespace

std::span<const StageRow> stage_rows() noexcept { return kStages; }

Json fleet_json(const FleetTrial& trial, const FleetWorld& world, bool hash) {
  const FleetOptions& o = trial.options;
  const auto tiles = trial.map.tiles_per_worker();
  const Report total = total_of(trial);
  Json r;
  r["robots"] = o.robots;
  r["robot"] = o.robot;
  r["sensors_per_robot"] = trial.sensors;
  r["ranges_per_scan"] = trial.ranges_per_scan;
  r["scans_per_cycle"] = o.robots * o.scans;
  r["grid_cells"] = o.grid;
  r["cell_m"] = o.cell_m;
  r["extent_m"] = world.side_m;
  r["surfaces"] = world.surfaces;
  r["seed"] = o.seed;
  r["rule"] = name(trial.map.params().rule);
  r["models"] = trial.models;
  r["kernel"] = trial.map.kernel_name();
  r["executor"] = trial.map.executor_name();
  r["threads"] = std::count_if(tiles.begin(), tiles.end(), [](std::uint64_t n) { return n > 0; });
  r["concurrency"] = trial.executor->concurrency();
  r["tiles_per_worker"] = std::vector<std::uint64_t>(tiles.begin(), tiles.end());
  r["maths_version"] = kMathsVersion;
  r["deadline_ms"] = o.deadline_ms;
  r["policy"] = o.policy;
  r["paced"] = o.paced;
  r["cycles"] = trial.measured().size();
  r["warmup_cycles"] = o.warmup;
  Json stages = Json::object();
  for (const StageRow& stage : kStages) stages[stage.name] = to_json(stage_spread(trial, stage), 1000);
  r["stages_ms"] = stages;
  r["p99_ms"] = stages["whole"]["p99"];
  r["keeps_deadline"] = r["p99_ms"].get<double>() < o.deadline_ms;
  add_scans(r, trial);
  r["readings_per_cycle"] = to_json(trial.spread(readings));
  r["cells_per_cycle"] = to_json(trial.spread(cells));
  r["cells_against_2014"] = r["cells_per_cycle"]["mean"].get<double>() / kCells2014;
  r["tiles_rendered_per_cycle"] =
      to_json(trial.spread([](const CycleRow& row) { return static_cast<double>(row.rendered.tiles); }));
  r["cells_rendered_per_cycle"] =
      to_json(trial.spread([](const CycleRow& row) { return static_cast<double>(row.rendered.cells); }));
  r["cells_updated"] = total.cells_updated;
  r["readings_used"] = total.readings_used;
  r["readings_refused"] = refused(total);
  r["tiles"] = trial.map.tiles();
  r["memory_bytes"] = trial.map.memory_bytes();
  if (trial.map.paged_bytes() > 0) r["paged_bytes"] = trial.map.paged_bytes();
  r["costmap_bytes"] = trial.costs.memory_bytes();
  r["process_peak_bytes"] = peak_bytes();
  r["building_s"] = world.made_s;
  r["placing_s"] = trial.placed_s;
  if (hash) r["map_hash"] = fmt::format("{:016x}", trial.map.hash());
  return r;
}

std::string fleet_text(const FleetTrial& trial, const FleetWorld& world, const Json& r) {
  const FleetOptions& o = trial.options;
  std::string out = fmt::format(
      "{} robots ({}) x {} sensors x {} scans a cycle; building {:.0f} x {:.0f} m, {} x {} cells of {:g} m, {} "
      "surfaces, "
      "seed {}\n{}, {}; {}, {}, {} threads; policy {}; {} cycles after {} to warm up\n\n"
      "ms            p50       p95       p99       max      mean\n",
      o.robots, o.robot, trial.sensors, o.scans, world.side_m, world.side_m, o.grid, o.grid, o.cell_m, world.surfaces,
      o.seed, r["rule"].get<std::string>(), fmt::join(trial.models, " + "), r["kernel"].get<std::string>(),
      r["executor"].get<std::string>(), r["concurrency"].get<int>(), o.policy, trial.measured().size(), o.warmup);
  for (const StageRow& stage : kStages) {
    const Spread s = stage_spread(trial, stage);
    out += fmt::format("{:8} {:9.3f} {:9.3f} {:9.3f} {:9.3f} {:9.3f}\n", stage.name, s.p50 * 1e3, s.p95 * 1e3,
                       s.p99 * 1e3, s.max * 1e3, s.mean * 1e3);
  }
  const auto mean = [&](const char* what) { return r[what]["mean"].get<double>(); };
  out += fmt::format("\ndeadline {:g} ms missed in {} of {} cycles\n", o.deadline_ms, trial.missed(),
                     trial.measured().size());
  out += fmt::format(
      "a cycle: {:.0f} readings, {:.0f} cells fused ({:.1f} x the 50 000 of Li et al. 2014), {:.0f} cells in "
      "{:.0f} tiles rendered\n",
      mean("readings_per_cycle"), mean("cells_per_cycle"), mean("cells_per_cycle") / kCells2014,
      mean("cells_rendered_per_cycle"), mean("tiles_rendered_per_cycle"));
  const CycleResult& c = trial.cycles;
  if (o.policy != "none")
    out += fmt::format(
        "scans: {} made, {} fused, {} skipped to thin out, {} cut short, {} held back, at most {} waiting, {} "
        "cycles to drain\n",
        c.made, c.fused, c.thinned, c.cut_short, r["scans_held_back"].get<std::uint64_t>(), c.most_waiting,
        r["drain_cycles"].get<std::uint64_t>());
  out +=
      fmt::format("memory: map {:.1f} MB in {} tiles, costmap {:.1f} MB, process at most {:.1f} MB\n",
                  static_cast<double>(trial.map.memory_bytes()) / 1e6, trial.map.tiles(),
                  static_cast<double>(trial.costs.memory_bytes()) / 1e6, r["process_peak_bytes"].get<double>() / 1e6);
  if (r.contains("map_hash")) out += fmt::format("map hash {}\n", r["map_hash"].get<std::string>());
  return out;
}

Json rows_json(const FleetTrial& trial) {
  Json rows = Json::array();
  for (const CycleRow& row : trial.cycles.rows) {
    Json one{{"cycle", row.cycle}, {"drain", row.drain ? 1 : 0}};
    for (const StageRow& stage : kStages) one[std::string(stage.name) + "_ms"] = row.*stage.seconds * 1000;
    one["made"] = row.made;
    one["fused"] = row.fused;
    one["thinned"] = row.thinned;
    one["cut_short"] = row.cut_short;
    one["held_back"] = row.held_back;
    one["backlog"] = row.backlog;
    one["readings"] = row.report.readings_used + row.report.refused_total();
    one["readings_refused"] = row.report.refused_total();
    one["cells"] = row.report.cells_updated;
    one["tiles_rendered"] = row.rendered.tiles;
    one["cells_rendered"] = row.rendered.cells;
    rows.push_back(std::move(one));
  }
  return rows;
}

std::string rows_csv(const FleetTrial& trial) {
  std::string out;
  for (const Json& row : rows_json(trial)) {
    std::string names, values;
    for (const auto& [key, value] : row.items()) {
      names.append(names.empty() ? "" : ",").append(key);
      values.append(values.empty() ? "" : ",").append(value.dump());
    }
    if (out.empty()) out = names + "\n";
    out += values + "\n";
  }
  return out;
}

}  // namespace evigrid::driver
