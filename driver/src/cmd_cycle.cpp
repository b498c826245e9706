// SPDX-License-Identifier: Apache-2.0
// evigrid cycle: a fleet of robots in a generated building, cycle by cycle, against a deadline. What is timed and what
// the policies mean: docs/cycle.md.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <optional>

#include "commands.hpp"
#include "cycle/find_max.hpp"
#include "cycle/fleet_report.hpp"
#include "cycle/fleet_run.hpp"
#include "cycle/replay.hpp"
#include "error.hpp"
#include "given_options.hpp"
#include "options.hpp"
#include "out/out_dir.hpp"
#include "progress.hpp"
#include "saved_map.hpp"
#include "simulated.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kTolerance = 0.02;  // of --find-max

/// Files and the report on standard output; everything is committed together at the end.
class Results {
 public:
  explicit Results(const FleetOptions& o) : json_(o.json) {
    if (!o.out_dir.empty()) out_.emplace(o.out_dir);
    if (!json_.empty() && json_ != "-") require_writable(json_);
  }
  void say(const std::string& text) const {
    if (json_ != "-") std::cout << text << std::flush;
  }
  OutDir* dir() { return out_ ? &*out_ : nullptr; }
  void finish(const Json& report) {
    const std::string bytes = report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    if (out_) {
      out_->write("report.json", bytes);
      out_->commit();
    }
    if (json_ == "-") {
      std::cout << bytes;
    } else if (!json_.empty()) {
      write_file(json_, bytes);
    }
  }

 private:
  std::string json_;
  std::optional<OutDir> out_;
};

std::string trial_line(const Json& r, bool gave_up) {
  const Json& whole = r["stages_ms"]["whole"];
  return fmt::format(
      "{:9} robots   p50 {:8.2f}   p95 {:8.2f}   p99 {:8.2f}   max {:8.2f} ms   {:.1f} M cells a cycle   {}\n",
      r["robots"].get<std::int64_t>(), whole["p50"].get<double>(), whole["p95"].get<double>(),
      whole["p99"].get<double>(), whole["max"].get<double>(), r["cells_per_cycle"]["mean"].get<double>() / 1e6,
      gave_up                           ? "too slow, stopped early"
      : r["keeps_deadline"].get<bool>() ? "in time"
                                        : "too slow");
}

Json run_once(const FleetWorld& world, const FleetOptions& o, Results& results) {
  TrialExtras extras;
  extras.log = o.log.empty() && o.policy == "skip" ? o.out_dir + "/scans.evilog" : o.log;
  Progress progress("cycles");
  extras.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
  const FleetTrial trial = run_trial(world, o, extras);
  Json report = fleet_json(trial, world, true);
  if (!extras.log.empty()) report["log"] = extras.log;
  results.say(fleet_text(trial, world, report));
  report["rows"] = rows_json(trial);
  if (OutDir* out = results.dir()) {
    out->write("cycles.csv", rows_csv(trial));
    out->write("cycles.png", png(draw_cycles(trial)), {});
    out->write("fleet.png", png(draw_fleet(trial)), {});
    if (o.save_map) out->write_by(kMapFile, [&](std::ostream& file) { save(trial.map, file); });
  }
  return report;
}

Json search(const FleetWorld& world, const FleetOptions& o, Results& results) {
  results.say(fmt::format("largest fleet with p99 < {:g} ms of {} cycles ({} before them to warm up), to {:.0f} %:\n",
                          o.deadline_ms, o.cycles, o.warmup, 100 * kTolerance));
  Json trials = Json::array(), best;
  std::int64_t tried = 0;
  const auto passes = [&](std::int64_t robots) {
    const FleetOptions one = with(o, "robots", static_cast<double>(robots));
    Progress progress(fmt::format("trial {}: {} robots", ++tried, robots));
    TrialExtras extras;
    extras.stop_when_lost = true;
    extras.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
    const FleetTrial trial = run_trial(world, one, extras);
    Json report = fleet_json(trial, world, false);
    report["stopped_early"] = trial.cycles.gave_up;
    const bool good = report["keeps_deadline"].get<bool>() && !trial.cycles.gave_up;
    results.say(trial_line(report, trial.cycles.gave_up));
    if (good && (best.is_null() || best["robots"].get<std::int64_t>() < robots)) best = report;
    trials.push_back(std::move(report));
    return good;
  };
  const std::int64_t found = find_max({o.robots, o.most_robots, kTolerance}, passes);
  results.say(found == 0 ? "not even one robot keeps the deadline\n"
                         : fmt::format("largest fleet: {} robots\n", found));
  if (OutDir* out = results.dir()) {
    std::vector<SweepPoint> points;
    for (const Json& trial : trials) points.push_back({trial["robots"].get<double>(), trial});
    std::sort(points.begin(), points.end(), [](const SweepPoint& a, const SweepPoint& b) { return a.value < b.value; });
    out->write("trials.png", png(draw_sweep("robots", points, o.deadline_ms)), {});
  }
  Json report = best.is_null() ? Json::object() : best;
  report["largest_fleet"] = found;
  report["tolerance"] = kTolerance;
  report["trials"] = std::move(trials);
  return report;
}

Json sweep_all(std::optional<FleetWorld> world, const FleetOptions& o, Results& results) {
  Json report = Json::object();
  for (const Sweep& sweep : parse_sweeps(o.sweeps)) {
    results.say(fmt::format("against {}:\n", sweep.what));
    std::vector<SweepPoint> points;
    Json rows = Json::array();
    for (const double value : sweep.values) {
      const FleetOptions one = with(o, sweep.what, value);
      std::optional<FleetWorld> own;
      if (sweep.what == "grid" || sweep.what == "cell") own.emplace(one);
      const FleetWorld& here = own ? *own : *world;
      const FleetTrial trial = run_trial(here, one);
      points.push_back({value, fleet_json(trial, here, false)});
      results.say(fmt::format("{:>10} {:10g} ", sweep.what, value) + trial_line(points.back().report, false));
      rows.push_back(points.back().report);
      rows.back()["value"] = value;
    }
    report[sweep.what] = std::move(rows);
    if (OutDir* out = results.dir())
      out->write("sweep_" + sweep.what + ".png", png(draw_sweep(sweep.what, points, o.deadline_ms)), {});
  }
  return Json{{"sweeps", std::move(report)}};
}

Json replay_log(const FleetOptions& o, std::optional<std::size_t> memory_cap_bytes, Results& results) {
  LoadOptions how{parse_executor(o.executor, o.threads), parse_kernel(o.kernel), memory_cap_bytes};
  if (!o.page_dir.empty()) how.page_directory = o.page_dir;
  const Replayed r = replay(o.replay, parse_part(o.part), how);
  const std::string hash = fmt::format("{:016x}", r.map.hash());
  results.say(fmt::format("{}: {} of {} scans fused in {:.3f} s, {} cells updated, map hash {}\n", o.replay, r.scans,
                          r.logged, r.fusion_s, r.report.cells_updated, hash));
  if (OutDir* out = results.dir()) out->write_by(kMapFile, [&](std::ostream& file) { save(r.map, file); });
  Json report{{"replay", o.replay},
              {"part", o.part},
              {"scans", r.scans},
              {"scans_logged", r.logged},
              {"cells_updated", r.report.cells_updated},
              {"readings_used", r.report.readings_used},
              {"fusion_s", r.fusion_s},
              {"map_hash", hash},
              {"memory_bytes", r.map.memory_bytes()}};
  if (r.map.paged_bytes() > 0) report["paged_bytes"] = r.map.paged_bytes();
  return report;
}

void run_cycle(const FleetOptions& o, const CLI::App& command) {
  std::optional<std::size_t> replay_cap;  // none given: that of the run which wrote the log
  if (o.replay.empty()) {
    refuse_given(command, {"--part"}, "is for --replay");
    if (!o.find_max) refuse_given(command, {"--most-robots"}, "is for --find-max");
    if (parse_policy(o.policy) == Policy::none) refuse_given(command, {"--slice"}, "is for --policy backlog or skip");
    (void)plan_fleet(o);
    for (const Sweep& sweep : parse_sweeps(o.sweeps))
      for (const double value : sweep.values) (void)plan_fleet(with(o, sweep.what, value));
  } else {
    (void)parse_part(o.part);
    refuse_given_but(command,
                     {"--replay", "--part", "--save-map", "--memory-mb", "--page-dir", "--threads", "--executor",
                      "--kernel", "--out", "--json"},
                     "is not for --replay, which fuses what a log holds");
    if (o.save_map && o.out_dir.empty()) throw InputError("--save-map: needs -o DIR");
    if (command.count("--memory-mb") > 0) replay_cap = memory_cap(o.memory_mb);
  }
  Results results(o);
  Json report;
  if (!o.replay.empty()) {
    report = replay_log(o, replay_cap, results);
  } else {
    FleetWorld world(o);
    report = o.find_max          ? search(world, o, results)
             : !o.sweeps.empty() ? sweep_all(std::move(world), o, results)
                                 : run_once(world, o, results);
  }
  results.finish(report);
}

}  // namespace

void add_cycle(CLI::App& app) {
  auto options = std::make_shared<FleetOptions>();
  FleetOptions& o = *options;
  CLI::App* command =
      app.add_subcommand("cycle", "a fleet of robots in a large building, every cycle timed against a deadline");
  const auto add = [&](const char* name, auto& field, const std::string& help) {
    return command->add_option(name, field, help);
  };
  add("--robots", o.robots, "robots; the first try of --find-max")->capture_default_str();
  add("--grid", o.grid, "side of the building in cells")->capture_default_str();
  add("--cell", o.cell_m, "side of a cell, m")->capture_default_str();
  add("--deadline-ms", o.deadline_ms, "time of a cycle, also by the robots' clocks")->capture_default_str();
  add("--cycles", o.cycles, "cycles that count")->capture_default_str();
  add("--warmup", o.warmup, "cycles before them: mapped, but not in the percentiles")->capture_default_str();
  add("--scans", o.scans, "scans that each robot makes in a cycle")->capture_default_str();
  command->add_flag("--find-max", o.find_max, "search the largest fleet whose p99 is below the deadline");
  add("--most-robots", o.most_robots, "where --find-max stops")->capture_default_str();
  add("--sweep", o.sweeps,
      "NAME=V,V,...: the same with one option varied: robots, sensors, grid, cell, threads or scans; several may be "
      "given")
      ->allow_extra_args(false);
  add("--policy", o.policy, "when a cycle would overrun: none, backlog or skip")->capture_default_str();
  add("--backlog", o.backlog, "scans that may wait (default: two cycles' scans)");
  add("--slice", o.slice, "scans fused between two looks at the clock, with a policy")->capture_default_str();
  command->add_flag("--paced", o.paced, "sleep out the rest of each cycle, as real robots do");
  add("--robot", o.robot, "robot by name or .toml file")->capture_default_str();
  add("--sensors", o.sensors, "so many of the robot's first sonar, all around (default: its own sensors)");
  add("--seed", o.seed, "of building, ways and noise")->capture_default_str();
  add("--room", o.room_m, "about the side of a room, m")->capture_default_str();
  add("--speed", o.speed_m_s, "of the robots, m/s")->capture_default_str();
  add("--rule", o.rule, "combination rule: " + map_rule_names())->capture_default_str();
  add("--model", o.model, "model of every sonar: " + model_names() + " (default: the robot's)");
  add("--max-range", o.max_range_m, "m: of every sensor (default: the robot's)");
  add("--reliability", o.reliability, "Shafer discount in (0, 1] (default: the robot's)");
  add("--log", o.log, "write every scan to this file, marked fused or skipped");
  add("--replay", o.replay, "fuse such a file instead");
  add("--part", o.part, "of --replay: all, fused, or late (the fused, then the skipped)")->capture_default_str();
  command->add_flag("--save-map", o.save_map, "also write map.evigrid into -o");
  add("--memory-mb", o.memory_mb, "cap of the map, MiB of its tiles (of --replay: that of the logged run)")
      ->capture_default_str();
  add("--page-dir", o.page_dir, "beyond that cap, tiles that changed longest ago go to a file in this folder");
  add("--threads", o.threads, "worker threads; 0: as many as the machine has")->capture_default_str();
  add("--executor", o.executor, "serial, tbb, openmp or spin; the map is the same")->capture_default_str();
  add("--kernel", o.kernel, "auto, scalar, avx2, avx512 or cuda; the map is the same")->capture_default_str();
  add("-o,--out", o.out_dir, "folder for report.json, cycles.csv and pictures; made when missing");
  add("--json", o.json, "also write the report to this file; - for standard output");
  command->footer(
      "In each cycle all robots drive, cast, and are fused into one map in the order (stamp, robot, sensor); what "
      "changed is\n"
      "rendered into a costmap. Percentiles are by nearest rank. docs/cycle.md says what is timed and what the "
      "policies mean.\n\n"
      "Examples:\n"
      "  evigrid cycle --robots 200 --grid 4096 --deadline-ms 100\n"
      "  evigrid cycle --robots 500 --grid 16384 --deadline-ms 100 --find-max -o out/fleet\n"
      "  evigrid cycle --robots 300 --policy backlog --backlog 900 --deadline-ms 20\n"
      "  evigrid cycle --robots 300 --policy skip --deadline-ms 20 -o out/skip\n"
      "  evigrid cycle --replay out/skip/scans.evilog --part fused\n"
      "  evigrid cycle --replay out/skip/scans.evilog --memory-mb 512 --page-dir /var/tmp\n"
      "  evigrid cycle --robots 200 --sweep robots=50,100,200 --sweep threads=1,2 -o out/sweep\n");
  command->callback([options, command] { run_cycle(*options, *command); });
}

}  // namespace evigrid::driver
