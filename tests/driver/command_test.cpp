// SPDX-License-Identifier: Apache-2.0
// Each command on good input: files, columns, and the counts in the report.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "evigrid/scenes/scene.hpp"
#include "program.hpp"
#include "records.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;
using Names = std::set<std::string>;

std::string odd_log() {
  return "# made up\nPARAM a 1\nHELLO 1\n" + flaser(180, "3.5", 5) + flaser_with(180, 1, "nan", 6) +
         flaser_with(180, 2, "inf", 7) + flaser_with(180, 3, "-inf", 8) + flaser_with(180, 4, "-1", 9) +
         flaser_with(180, 5, "77777", 10) + flaser(180, "3.5", 1) + flaser(180, "3.5", 11, "nan 0 0") + "FLASER 3 1\n";
}

TEST(Map, WritesItsFilesAndCountsWhatItLeftOut) {
  const TempDir dir;
  const Ran ran = evigrid({"map", dir.write("odd.log", odd_log()), "-o", dir.at("out"), "--threads", "2"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(dir.names(), (Names{"odd.log", "out", "out/map.evigrid", "out/map.pgm", "out/map.png", "out/map.yaml",
                                "out/masses.npy", "out/report.json"}));
  const Json r = Json::parse(slurp(dir.at("out/report.json")));
  EXPECT_EQ(r["readings_used"], 7 * 180 - 5);
  EXPECT_EQ(r["readings_refused"], Json({{"not_a_number", 1},
                                         {"no_return", 1},
                                         {"too_close", 1},
                                         {"negative", 1},
                                         {"absurd", 1},
                                         {"pose_not_finite", 180}}));
  EXPECT_EQ(r["stamps_backwards"], 1);
  EXPECT_EQ(r["records_skipped"], Json({{"#", 1}, {"PARAM", 1}, {"HELLO", 1}}));
  EXPECT_EQ(r["records_malformed"], Json({{"too short", 1}}));
  EXPECT_EQ(r["warnings"].size(), 1u);
  EXPECT_EQ(r["rule"], "pcr5");
  EXPECT_EQ(r["models"], Json({"beam"}));
  EXPECT_EQ(r["cell_m"], 0.05);
  EXPECT_GT(r["cells_updated"], 0);
  EXPECT_EQ(r["map_hash"].get<std::string>().size(), 16u);
  for (const char* key : {"maths_version", "kernel", "executor", "threads", "tiles_per_worker", "size_cells", "wall_s",
                          "fusion_s", "max_conflict", "total_conflicts", "readings_clipped", "memory_bytes"}) {
    EXPECT_TRUE(r.contains(key)) << key;
  }
  std::uint64_t worked = 0;
  for (const auto& n : r["tiles_per_worker"]) worked += n > 0;
  EXPECT_EQ(r["threads"], worked);
}

TEST(Map, SameMapWhoeverComputesIt) {
  const TempDir dir;
  const std::string log = dir.write("odd.log", odd_log());
  std::set<std::string> hashes;
  const Json info = Json::parse(evigrid({"info", "--json", "-"}).out);
  for (const std::string kernel : info["kernels_available"]) {
    for (const std::string executor : {"serial", "tbb", "openmp"}) {
      const Ran ran =
          evigrid({"map", log, "-o", dir.at("out"), "--kernel", kernel, "--executor", executor, "--json", "-"});
      ASSERT_EQ(ran.code, 0) << ran.err;
      const Json r = Json::parse(ran.out);
      EXPECT_EQ(r["kernel"], kernel);
      EXPECT_EQ(r["executor"], executor);
      hashes.insert(r["map_hash"]);
    }
  }
  EXPECT_EQ(hashes.size(), 1u);
}

TEST(Map, OptionsReachTheEngine) {
  const TempDir dir;
  const std::string log =
      dir.write("a.log", flaser(180, "3.5", 1) + flaser(180, "3.4", 2) + flaser_with(180, 9, "inf", 3));
  const auto report = [&](std::vector<std::string> more) {
    std::vector<std::string> all{"map", log, "-o", dir.at("out"), "--json", "-"};
    all.insert(all.end(), more.begin(), more.end());
    const Ran ran = evigrid(all);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return Json::parse(ran.out);
  };
  const Json base = report({});
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--rule", "dempster"},
                                               {"--cell", "0.1"},
                                               {"--max-range", "2"},
                                               {"--reliability", "0.5"},
                                               {"--clear-no-return"}}) {
    EXPECT_NE(report(more)["map_hash"], base["map_hash"]) << more[0];
  }
  EXPECT_EQ(report({"--cell", "0.1"})["cell_m"], 0.1);
  EXPECT_EQ(report({"--max-range", "2"})["readings_clipped"], 539);
}

TEST(Map, JsonCopyIsTheReport) {
  const TempDir dir;
  const std::string log = dir.write("a.log", flaser(180, "3.5", 1));
  ASSERT_EQ(evigrid({"map", log, "-o", dir.at("out"), "--json", dir.at("copy.json")}).code, 0);
  EXPECT_EQ(slurp(dir.at("copy.json")), slurp(dir.at("out/report.json")));
}

TEST(Map, RingOfSonars) {
  const TempDir dir;
  dir.write("ring/poses.txt", "1000 0 0 0\n1200 100 0 0\n");
  dir.write("ring/measurement.txt",
            "1000 1000 1100 1200 1300 1400 1500 1600 5110\n1200 1000 1100 1200 1300 5080 100 1600 5110\n");
  const Ran ran = evigrid({"map", dir.at("ring"), "-o", dir.at("out"), "--json", "-"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json r = Json::parse(ran.out);
  EXPECT_EQ(r["models"], Json({"li2014"}));
  EXPECT_EQ(r["cell_m"], 0.1);
  EXPECT_EQ(r["readings_used"], 12);
  EXPECT_EQ(r["readings_refused"], Json({{"no_return", 2}, {"too_close", 1}, {"above_max_range", 1}}));
  EXPECT_EQ(r["sensors"][0]["reliability"], 0.9);
}

TEST(Run, EmbeddedSceneWithItsTimesApart) {
  const TempDir dir;
  const Ran ran = evigrid({"run", "-o", dir.at("out"), "--json", "-"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json r = Json::parse(ran.out);
  EXPECT_GT(r["readings_used"], 1000);
  EXPECT_EQ(r["sensors"].size(), 24u);
  EXPECT_GT(r["cast_s"], 0);
  EXPECT_GT(r["fusion_s"], 0);
  EXPECT_LE(r["cast_s"].get<double>() + r["fusion_s"].get<double>(), r["wall_s"].get<double>());
  EXPECT_TRUE(dir.names().contains("out/map.png"));
}

TEST(Run, TheScenesRuleUnlessTheUserNamesOne) {
  const TempDir dir;
  const std::string wanted = scenes::parse_scene(scenes::default_scene_text(), "embedded").map.rule;
  const std::string other = wanted == "pcr2" ? "pcr5" : "pcr2";
  EXPECT_EQ(Json::parse(evigrid({"run", "-o", dir.at("out"), "--json", "-"}).out)["rule"], wanted);
  EXPECT_EQ(Json::parse(evigrid({"run", "-o", dir.at("out"), "--json", "-", "--rule", other}).out)["rule"], other);
}

TEST(Cast, RowsForEveryStepAndSensor) {
  const Ran ran = evigrid({"cast", "--truth"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(starts_with(ran.out, "step,stamp_ns,x_m,y_m,yaw_rad,sensor,range_m,truth\n0,0,"));
  EXPECT_EQ((std::count(ran.out.begin(), ran.out.end(), '\n') - 1) % 24, 0);
  EXPECT_TRUE(starts_with(evigrid({"cast"}).out, "step,stamp_ns,x_m,y_m,yaw_rad,sensor,range_m\n"));
}

TEST(Combine, OneRowForOneRowFromFileAndStandardInput) {
  const TempDir dir;
  const std::string csv = "e1,o1,e2,o2\n0.6,0,0,0.4\n0,0,0,0\n1,0,0,1\n";
  const Ran piped = evigrid({"combine", "--rule", "dempster", "--double"}, csv);
  ASSERT_EQ(piped.code, 0) << piped.err;
  std::istringstream lines(piped.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "e,o,u,c,k");
  double e = 0, o = 0, u = 0, c = 0, k = 0;
  std::getline(lines, line);
  ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &e, &o, &u, &c, &k), 5) << line;
  EXPECT_NEAR(e, 0.36 / 0.76, 1e-15);  // (0.6·0.6, 0.4·0.4, 0.4·0.6) over 1 − 0.24
  EXPECT_NEAR(o, 0.16 / 0.76, 1e-15);
  EXPECT_NEAR(u, 0.24 / 0.76, 1e-15);
  EXPECT_NEAR(k, 0.24, 1e-15);
  std::getline(lines, line);
  EXPECT_EQ(line, "0,0,1,0,0");
  std::getline(lines, line);
  EXPECT_EQ(line, "0,0,1,0,1");  // total conflict: the vacuous mass
  EXPECT_TRUE(contains(piped.err, "1 of 3 rows in total conflict"));
  const Ran file =
      evigrid({"combine", "--rule", "dempster", "--double", "--in", dir.write("a.csv", csv), "-o", dir.at("b.csv")});
  EXPECT_EQ(file.code, 0);
  EXPECT_EQ(slurp(dir.at("b.csv")), piped.out);
}

std::vector<std::array<double, 5>> rows_of(const Ran& ran) {
  std::vector<std::array<double, 5>> out;
  std::istringstream lines(ran.out);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    auto& r = out.emplace_back();
    EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &r[0], &r[1], &r[2], &r[3], &r[4]), 5) << line;
  }
  return out;
}

// Smarandache and Dezert: three sources, conjunctively .537, .09, .03 and k = .343.
TEST(Combine, ThreeSourcesOneAfterTheOther) {
  const std::string csv = "e1,o1,e2,o2,e3,o3\n.6,.1,.5,.3,.4,.1\n";
  const Ran ran = evigrid({"combine", "--rule", "conjunctive", "--sources", "3", "--double"}, csv);
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto rows = rows_of(ran);
  ASSERT_EQ(rows.size(), 1u);
  const std::array<double, 4> want{.537, .09, .03, .343};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(rows[0][i], want[i], 1e-12) << i;
  EXPECT_NEAR(rows[0][4], .23 + (.57 * .1 + .14 * .4), 1e-12);  // both steps' k
  for (const char* rule : {"pcr5", "yager", "fuzzy", "cautious"}) {
    EXPECT_EQ(evigrid({"combine", "--rule", rule, "--sources", "3"}, csv).code, 0) << rule;
  }
}

// Dezert, Dezert & Smarandache 2021: three sources at once; in order pcr5plus is pcr5, step by step.
TEST(Combine, SeveralSourcesTakeTheJointFormOfTheRule) {
  const std::string csv = "e1,o1,e2,o2,e3,o3\n.6,.1,.5,.3,.4,.1\n";
  const auto run = [&](std::vector<std::string> more) {
    std::vector<std::string> args{"combine", "--sources", "3", "--double", "--rule"};
    args.insert(args.end(), more.begin(), more.end());
    return rows_of(evigrid(args, csv)).at(0);
  };
  EXPECT_NEAR(run({"pcr5"})[0], .723281, 5.1e-7);
  EXPECT_NEAR(run({"pcr6"})[0], .743496, 5.1e-7);
  EXPECT_NEAR(run({"pcr5plus"})[0], .768631, 5.1e-7);
  EXPECT_NEAR(run({"pcr6plus"})[0], .788847, 5.1e-7);
  EXPECT_NEAR(run({"pcr6plus"})[4], .343, 1e-12);
  EXPECT_EQ(run({"pcr5", "--in-order"}), run({"pcr5plus", "--in-order"}));
  EXPECT_GT(std::abs(run({"pcr5", "--in-order"})[0] - run({"pcr5"})[0]), 1e-3);
  EXPECT_EQ(run({"dempster", "--in-order"}), run({"dempster"}));
}

TEST(Combine, TooManySourcesForAJointFormAreRefusedByName) {
  std::string csv = "e1,o1", row = "\n.1,.2";
  for (int s = 2; s <= 9; ++s) csv += ",e" + std::to_string(s) + ",o" + std::to_string(s), row += ",.1,.2";
  csv += row + "\n";
  const Ran ran = evigrid({"combine", "--rule", "pcr5", "--sources", "9"}, csv);
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("--in-order"), std::string::npos) << ran.err;
  EXPECT_EQ(evigrid({"combine", "--rule", "pcr5", "--sources", "9", "--in-order"}, csv).code, 0);
}

// Three sources of (.6, 0, .4) and two of (0, .6, .4): the mean (.36, .24, .4), four times with itself.
TEST(Combine, MurphyTakesTheMeanOfAllSources) {
  const std::string csv = "e1,o1,e2,o2,e3,o3,e4,o4,e5,o5\n.6,0,0,.6,.6,0,0,.6,.6,0\n";
  const Ran ran = evigrid({"combine", "--rule", "murphy", "--sources", "5", "--double"}, csv);
  ASSERT_EQ(ran.code, 0) << ran.err;
  const double e = std::pow(.76, 5) - std::pow(.4, 5), o = std::pow(.64, 5) - std::pow(.4, 5), u = std::pow(.4, 5);
  const auto rows = rows_of(ran);
  EXPECT_NEAR(rows.at(0)[0], e / (e + o + u), 1e-14);
  EXPECT_NEAR(rows.at(0)[1], o / (e + o + u), 1e-14);
  const Ran two = evigrid({"combine", "--rule", "murphy", "--double"}, "e1,o1,e2,o2,c2\n.6,0,.3,.1,.5\n");
  EXPECT_EQ(two.code, 0);  // c2 dropped: the second source is (.6, .2, .2)
  const double a = .6, b = .1, v = .3, sum = 1 - 2 * a * b;
  EXPECT_NEAR(rows_of(two).at(0)[0], a * (a + 2 * v) / sum, 1e-14);
}

TEST(Combine, ParadoxicalMassesAreReadAndWritten) {
  const std::string csv = "e1,o1,c1,e2,o2,c2\n.3,.2,.1,.1,.4,.2\n";
  const auto conjunctive = rows_of(evigrid({"combine", "--rule", "dsmc", "--double"}, csv));
  EXPECT_NEAR(conjunctive.at(0)[3], .1 + .2 - .02 + (.3 * .4 + .2 * .1), 1e-15);
  const auto hybrid = rows_of(evigrid({"combine", "--rule", "dsmh", "--double"}, csv));
  EXPECT_NEAR(hybrid.at(0)[0], .3 * (.1 + .3) + .4 * .1 + .3 * .2 + .1 * .1, 1e-15);
  EXPECT_EQ(hybrid.at(0)[3], 0);
}

TEST(Model, PublishedRowOfLi2014) {
  const Ran ran = evigrid({"model", "li2014", "--reading", "1.493", "--at", "1.5,0", "--at", "9,0"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  double d = 0, theta = 0, e = 0, o = 0, u = 0, c = 0;
  ASSERT_TRUE(starts_with(ran.out, "d_m,theta_deg,e,o,u,c\n"));
  ASSERT_EQ(std::sscanf(ran.out.c_str() + ran.out.find('\n'), "%lf,%lf,%lf,%lf,%lf,%lf", &d, &theta, &e, &o, &u, &c),
            6);
  EXPECT_NEAR(e, 0.0079, 1.1e-4);  // Li et al. 2014, table 3
  EXPECT_NEAR(o, 0.9680, 1.1e-4);
  EXPECT_NEAR(c, 0.0242, 1.1e-4);
  EXPECT_TRUE(contains(ran.out, "\n9,0,0,0,1,0\n"));
  EXPECT_EQ(evigrid({"model", "beam", "--reading", "3", "--grid"}).code, 0);
}

TEST(Info, FactsAsTextAndJson) {
  const Ran text = evigrid({"info"});
  EXPECT_EQ(text.code, 0);
  EXPECT_TRUE(contains(text.out, "kernel_chosen"));
  const Json facts = Json::parse(evigrid({"info", "--json", "-"}).out);
  EXPECT_TRUE(contains(facts["kernels_available"].dump(), "scalar"));
  EXPECT_NE(facts["packages"]["TBB"], "");
  EXPECT_NE(facts["packages"]["Embree"], "");
}

TEST(Help, EveryCommandShowsExamples) {
  EXPECT_EQ(evigrid({"--help"}).code, 0);
  EXPECT_EQ(evigrid({"--version"}).out, "evigrid 0.1.0\n");
  for (const char* command : {"map", "run", "cast", "combine", "model", "info", "show"}) {
    const Ran ran = evigrid({command, "--help"});
    EXPECT_EQ(ran.code, 0) << command;
    EXPECT_TRUE(contains(ran.out, "Examples:")) << command;
  }
}

}  // namespace
}  // namespace evigrid::driver
