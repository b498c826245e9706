// SPDX-License-Identifier: Apache-2.0
// evigrid cycle as a user calls it. No assertion looks at how long anything took.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "program.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;

const std::vector<std::string> kSmall{"cycle", "--robots", "5", "--grid", "512", "--cycles", "6", "--warmup", "2"};

std::vector<std::string> small(const std::vector<std::string>& more) {
  std::vector<std::string> all = kSmall;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

Json report(const std::vector<std::string>& arguments) {
  const Ran ran = evigrid(arguments);
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.err, "");
  return ran.code == 0 ? Json::parse(ran.out) : Json();
}

TEST(Cycle, TheReportHoldsWhatItShould) {
  const TempDir dir;
  const Json r = report(small({"--json", "-", "-o", dir.at("out")}));
  for (const char* field : {"robots",
                            "sensors_per_robot",
                            "grid_cells",
                            "cell_m",
                            "extent_m",
                            "seed",
                            "rule",
                            "models",
                            "kernel",
                            "executor",
                            "threads",
                            "concurrency",
                            "tiles_per_worker",
                            "maths_version",
                            "deadline_ms",
                            "policy",
                            "cycles",
                            "stages_ms",
                            "p99_ms",
                            "missed_cycles",
                            "readings_per_cycle",
                            "cells_per_cycle",
                            "cells_against_2014",
                            "cells_rendered_per_cycle",
                            "cells_updated",
                            "readings_used",
                            "readings_refused",
                            "memory_bytes",
                            "costmap_bytes",
                            "process_peak_bytes",
                            "map_hash",
                            "rows"})
    EXPECT_TRUE(r.contains(field)) << field;
  for (const char* stage : {"drive", "cast", "fuse", "render", "whole"})
    for (const char* part : {"p50", "p95", "p99", "max", "mean"})
      EXPECT_TRUE(r["stages_ms"][stage].contains(part)) << stage;
  EXPECT_EQ(r["robots"], 5);
  EXPECT_EQ(r["sensors_per_robot"], 24);
  EXPECT_EQ(r["cycles"], 6);
  ASSERT_EQ(r["rows"].size(), 8u);
  std::uint64_t cells = 0, readings = 0;
  for (const Json& row : r["rows"]) {
    cells += row["cells"].get<std::uint64_t>();
    readings += row["readings"].get<std::uint64_t>();
    EXPECT_EQ(row["readings"], 5 * 24);
    EXPECT_GT(row["cells_rendered"], 0);
  }
  EXPECT_EQ(r["cells_updated"], cells);
  std::uint64_t refused = 0;
  for (const auto& [why, n] : r["readings_refused"].items()) refused += n.get<std::uint64_t>();
  EXPECT_EQ(r["readings_used"].get<std::uint64_t>() + refused, readings);
  EXPECT_EQ(dir.names(),
            (std::set<std::string>{"out", "out/report.json", "out/cycles.csv", "out/cycles.png", "out/fleet.png"}));
  EXPECT_EQ(Json::parse(slurp(dir.at("out/report.json")))["map_hash"], r["map_hash"]);
  std::istringstream csv(slurp(dir.at("out/cycles.csv")));
  std::string line;
  int lines = 0;
  while (std::getline(csv, line)) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 17) << line;
    ++lines;
  }
  EXPECT_EQ(lines, 9);
}

TEST(Cycle, PoliciesAndReplayMakeTheSameMap) {
  const TempDir dir;
  const std::string hash = report(small({"--json", "-"}))["map_hash"];
  const Json backlog = report(small({"--json", "-", "--policy", "backlog", "--backlog", "3", "--slice", "1",
                                     "--deadline-ms", "100", "--threads", "1"}));
  EXPECT_EQ(backlog["map_hash"], hash);
  EXPECT_EQ(backlog["scans_made"], 40);
  EXPECT_EQ(backlog["scans_fused"], 40);
  EXPECT_GT(backlog["scans_held_back"], 0);  // three have room where five want in
  EXPECT_LE(backlog["most_scans_waiting"], 3);
  const Json skip =
      report(small({"--json", "-", "--policy", "skip", "--slice", "1", "--log", dir.at("log"), "--memory-mb", "500"}));
  EXPECT_EQ(skip["scans_made"], 40);
  const Json all = report({"cycle", "--replay", dir.at("log"), "--json", "-"});
  EXPECT_EQ(all["map_hash"], hash);
  EXPECT_EQ(all["scans"], 40);
  EXPECT_EQ(
      report({"cycle", "--replay", dir.at("log"), "--part", "fused", "--json", "-", "--threads", "2"})["map_hash"],
      skip["map_hash"]);
  EXPECT_EQ(report({"cycle", "--replay", dir.at("log"), "--json", "-", "--executor", "serial", "--kernel", "scalar",
                    "--save-map", "-o", dir.at("out")})["map_hash"],
            hash);
}

TEST(Cycle, SeveralScansARobotsOwnSensorsAndLasers) {
  const Json several = report(small({"--json", "-", "--scans", "3", "--sensors", "6"}));
  EXPECT_EQ(several["rows"][0]["readings"], 5 * 6 * 3);
  const Json laser = report(small({"--json", "-", "--robot", "laser180", "--max-range", "8"}));
  EXPECT_EQ(laser["rows"][0]["readings"], 5 * 181);
  EXPECT_EQ(laser["models"], Json({"beam"}));
  EXPECT_NE(report(small({"--json", "-", "--seed", "2"}))["map_hash"], report(small({"--json", "-"}))["map_hash"]);
}

TEST(Cycle, SearchAndSweepPrintEachTrial) {
  const TempDir dir;
  const Ran found =
      evigrid(small({"--find-max", "--most-robots", "20", "--deadline-ms", "60000", "-o", dir.at("max")}));
  ASSERT_EQ(found.code, 0) << found.err;
  EXPECT_TRUE(contains(found.out, "largest fleet: 20 robots"));
  const Json r = Json::parse(slurp(dir.at("max/report.json")));
  EXPECT_EQ(r["largest_fleet"], 20);
  EXPECT_EQ(dir.names().count("max/trials.png"), 1u);
  EXPECT_EQ(r["trials"].size(), 3u);  // 5, 10, 20
  const Ran none = evigrid(small({"--find-max", "--deadline-ms", "0.001"}));
  EXPECT_TRUE(contains(none.out, "not even one robot keeps the deadline")) << none.out << none.err;
  EXPECT_TRUE(contains(none.out, "stopped early"));
  const Ran swept = evigrid(small({"--sweep", "robots=1,3", "--sweep", "grid=256,512", "-o", dir.at("sweep")}));
  ASSERT_EQ(swept.code, 0) << swept.err;
  EXPECT_EQ(dir.names().count("sweep/sweep_robots.png"), 1u);
  EXPECT_EQ(dir.names().count("sweep/sweep_grid.png"), 1u);
  EXPECT_EQ(Json::parse(slurp(dir.at("sweep/report.json")))["sweeps"]["grid"][0]["grid_cells"], 256);
}

TEST(Cycle, WhatCannotBeIsRefusedWithItsName) {
  const TempDir dir;
  struct Row {
    std::vector<std::string> arguments;
    std::string message;
  };
  for (const Row& row :
       {Row{{"cycle", "--robots", "0"}, "--robots: 0 is not within"},
        Row{{"cycle", "--robots", "many"}, "--robots"},
        Row{{"cycle", "--grid", "64", "--cell", "0.01"}, "--grid 64 of 0.01 m cells"},
        Row{{"cycle", "--policy", "wait"}, "--policy: 'wait'"},
        Row{{"cycle", "--policy", "skip"}, "--log FILE or -o DIR"},
        Row{{"cycle", "--kernel", "neon"}, "--kernel"},
        Row{{"cycle", "--executor", "fibers"}, "--executor"},
        Row{{"cycle", "--sweep", "robots"}, "--sweep"},
        Row{{"cycle", "--sweep", "robots=0"}, "--sweep"},
        Row{{"cycle", "--part", "fused"}, "--part: is for --replay"},
        Row{{"cycle", "--part", "all"}, "--part: is for --replay"},
        Row{{"cycle", "--most-robots", "50"}, "--most-robots: is for --find-max"},
        Row{{"cycle", "--sweep", "robots=1,2", "--most-robots", "50"}, "--most-robots: is for --find-max"},
        Row{{"cycle", "--slice", "64"}, "--slice: is for --policy backlog or skip"},
        Row{{"cycle", "--find-max", "--slice", "8"}, "--slice: is for --policy backlog or skip"},
        Row{{"cycle", "--robot", "laser180", "--model", "li2014"}, "--model: laser180 has no sonar"},
        Row{{"cycle", "--replay", dir.at("none")}, "cannot be read"},
        Row{{"cycle", "--replay", dir.write("text", "hello, this is no log")}, "is no scan log"},
        Row{{"cycle", "--replay", dir.at("text"), "--part", "half"}, "--part: 'half'"},
        Row{{"cycle", "--replay", dir.at("text"), "--find-max"}, "--replay"},
        Row{{"cycle", "--replay", dir.at("text"), "--rule", "pcr5"}, "--rule: is not for --replay"},
        Row{{"cycle", "--replay", dir.at("text"), "--robots", "5"}, "--robots: is not for --replay"},
        Row{{"cycle", "--replay", dir.at("text"), "--memory-mb", "0"}, "--memory-mb: 0 is not within"},
        Row{{"cycle", "--replay", dir.at("text"), "--paced"}, "--paced: is not for --replay"},
        Row{{"cycle", "--robots", "50", "--grid", "512", "--memory-mb", "1"}, "--memory-mb"},
        Row{{"cycle", "--json", dir.at("no/folder/report")}, "cannot be written"}}) {
    const Ran ran = evigrid(row.arguments);
    EXPECT_EQ(ran.code, 2) << row.message << ran.err;
    EXPECT_TRUE(contains(ran.err, row.message)) << ran.err;
  }
  EXPECT_EQ(dir.names(), std::set<std::string>{"text"});
  const Ran help = evigrid({"cycle", "--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_TRUE(contains(help.out, "Examples:"));
}

TEST(Cycle, ALogIsNotWrittenInADevicesPlace) {
  const TempDir dir;
  ASSERT_EQ(::mkfifo(dir.at("pipe").c_str(), 0600), 0);
  const Ran ran = evigrid(small({"--log", dir.at("pipe")}));
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("a device or a pipe"), std::string::npos) << ran.err;
  EXPECT_EQ(dir.names(), std::set<std::string>{"pipe"});
}

}  // namespace
}  // namespace evigrid::driver
