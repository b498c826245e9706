// SPDX-License-Identifier: Apache-2.0
// compare: one table over rules, models and robots, and scores that do not depend on who else is in it.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "decoded_png.hpp"
#include "peak_memory.hpp"
#include "program.hpp"
#include "records.hpp"
#include "text.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;

const std::string kRoom = R"([map]
cell_m = 0.1
rule = "pcr5"
[[world.polygons]]
vertices = [[0, 0], [6, 0], [6, 4], [0, 4]]
[robot]
use = "hughes24"
[trajectory]
waypoints = [[1, 1], [5, 1], [5, 3]]
seed = 3
)";

Json report_of(const TempDir& dir, const std::string& folder) {
  return Json::parse(slurp(dir.at(folder + "/report.json")));
}

TEST(Compare, EveryRuleAndModelOfASceneOnce) {
  const TempDir dir;
  const std::string scene = dir.write("room.toml", kRoom);
  const Ran ran = evigrid({"compare", scene, "-o", dir.at("out"), "--rules", "dempster,pcr5", "--models", "all"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json rows = report_of(dir, "out")["rows"];
  // Two rules by the four sonar models of masses; probability, fuzzy and moravec1985 go with neither rule.
  std::set<std::string> pairs;
  std::map<std::string, double> rerendered_m;
  for (const Json& row : rows) {
    pairs.insert(row["rule"].get<std::string>() + ' ' + row["model"].get<std::string>());
    EXPECT_GT(row["cells_updated"], 1000);
    EXPECT_GT(row["score"]["within_one_cell"]["recall"], 0.5);
    EXPECT_GT(row["rerender"]["readings"], 500);
    rerendered_m[row["rule"].get<std::string>() + ' ' + row["model"].get<std::string>()] = row["rerender"]["median_m"];
    const int flips = std::stoi(row["readings_to_flip"].get<std::string>());  // after 20: Dempster 21, PCR5 3
    EXPECT_NEAR(flips, row["rule"] == "pcr5" ? 3 : 21, row["rule"] == "pcr5" ? 0 : 1);
  }
  // Without the truth the metric must tell the sharpest maps of this room from the most smeared ones (precision within
  // a cell 0.74 and more against 0.42 and less).
  for (const std::string rule : {"dempster ", "pcr5 "})
    EXPECT_LT(1.5 * rerendered_m.at(rule + "hughes1992"), rerendered_m.at(rule + "li2006"));
  EXPECT_EQ(rows.size(), 8u);
  EXPECT_EQ(pairs,
            (std::set<std::string>{"dempster hughes1992", "dempster oriolo1997", "dempster li2006", "dempster li2014",
                                   "pcr5 hughes1992", "pcr5 oriolo1997", "pcr5 li2006", "pcr5 li2014"}));
  // The same numbers as `run` gives for one of them.
  const Ran one =
      evigrid({"run", scene, "-o", dir.at("one"), "--rule", "dempster", "--model", "li2014", "--json", "-"});
  ASSERT_EQ(one.code, 0) << one.err;
  const Json alone = Json::parse(one.out);
  bool found = false;
  for (const Json& row : rows) {
    if (row["rule"] != "dempster" || row["model"] != "li2014") continue;
    found = true;
    EXPECT_EQ(row["map_hash"], alone["map_hash"]);
    EXPECT_EQ(row["score"], alone["truth"]);
  }
  EXPECT_TRUE(found);
  for (const char* file : {"compare.csv", "compare.md", "sheet.png"}) {
    EXPECT_TRUE(std::filesystem::exists(dir.at(std::string("out/") + file))) << file;
  }
}

TEST(Compare, RobotsWithDifferentCellsOfTheirOwnShareOne) {
  const TempDir dir;
  const std::vector<std::string> world{"--world", "building", "--seed", "2"};
  std::vector<std::string> both{"compare", "-o",       dir.at("both"), "--robots", "ring8,laser360",
                                "--rules", "dempster", "--models",     "li2014",   "--max-range",
                                "3"};
  both.insert(both.end(), world.begin(), world.end());
  std::vector<std::string> alone{"compare",  "-o",       dir.at("alone"), "--robots",    "laser360", "--rules",
                                 "dempster", "--models", "li2014",        "--max-range", "3"};
  alone.insert(alone.end(), world.begin(), world.end());
  const Ran first = evigrid(both), second = evigrid(alone);
  ASSERT_EQ(first.code, 0) << first.err;
  ASSERT_EQ(second.code, 0) << second.err;
  const Json laser = report_of(dir, "both")["rows"][1], same = report_of(dir, "alone")["rows"][0];
  EXPECT_EQ(laser["robot"], "laser360");
  EXPECT_EQ(laser["map_hash"], same["map_hash"]);
  EXPECT_EQ(laser["score"], same["score"]);
}

TEST(Compare, BadWordsAreNamed) {
  const TempDir dir;
  const auto refused = [&](std::vector<std::string> arguments, const std::string& word) {
    arguments.insert(arguments.begin(), {"compare", "-o", dir.at("out")});
    const Ran ran = evigrid(arguments);
    EXPECT_EQ(ran.code, 2);
    EXPECT_TRUE(contains(ran.err, word)) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(dir.at("out")));
  };
  refused({"default", "--rules", "dempster,foo"}, "foo");
  refused({"default", "--models", "foo"}, "foo");
  refused({"default", "--rules", ","}, "--rules");
  refused({"default", "--robots", "foo"}, "foo");
  refused({"default", "--robots", ","}, "--robots: names no robot");
  refused({dir.at("missing.log")}, "missing.log");
  refused({"default", "--world", "building"}, "--world");
}

TEST(Run, AWorldThatCannotBeScoredStillGivesItsMap) {
  const TempDir dir;
  std::string scene = kRoom;
  scene.replace(scene.find("[6, 4]"), 6, "[6, 4000000]");
  scene.replace(scene.find("[0, 4]"), 6, "[0, 4000000]");
  const Ran ran = evigrid({"run", dir.write("far.toml", scene), "-o", dir.at("out"), "--json", "-"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(contains(Json::parse(ran.out)["truth"]["skipped"].dump(), "cells"));
  EXPECT_TRUE(std::filesystem::exists(dir.at("out/map.png")));
  EXPECT_FALSE(std::filesystem::exists(dir.at("out/truth.png")));
}

TEST(Compare, RulesThatCannotForgetAreLeftOut) {
  const TempDir dir;
  const std::string scene = dir.write("room.toml", kRoom);
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{"--decay", "100"}, {"--dependence", "cautious"}}) {
    std::vector<std::string> line{"compare",           scene,      "-o",        dir.at("out"), "--rules",
                                  "dempster,cautious", "--models", "hughes1992"};
    line.insert(line.end(), how.begin(), how.end());
    const Ran ran = evigrid(line);
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json rows = report_of(dir, "out")["rows"];
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0]["rule"], "dempster");
    line[5] = "cautious";
    const Ran none = evigrid(line);
    EXPECT_EQ(none.code, 2);
    EXPECT_TRUE(contains(none.err, "cautious")) << none.err;
  }
}

TEST(Compare, ALogWithoutPosesIsRefusedAsMapDoes) {
  const TempDir dir;
  std::string row;
  for (int i = 0; i < 24; ++i) row += "1.5,";
  const std::string log = dir.write("sensor_readings_24.data", row + "Move-Forward\n" + row + "Move-Forward\n");
  const Ran ran = evigrid({"compare", log, "-o", dir.at("out")});
  EXPECT_EQ(ran.code, 2);
  EXPECT_TRUE(contains(ran.err, "has no poses")) << ran.err;
  EXPECT_FALSE(std::filesystem::exists(dir.at("out")));
}

TEST(Compare, ManyRowsTakeNoMoreMemoryThanOne) {
  const TempDir dir;
  const std::string log = dir.write("far.log", flaser(180, "3.5", 1) + flaser(180, "3.5", 2, "70 70 0"));
  const auto peak = [&](const std::string& rules) {
    return peak_mb({"compare", log, "-o", dir.at("out"), "--rules", rules, "--threads", "1"});
  };
  const double one_row = peak("pcr5");  // 1500 x 1500 cells, 36 MB of planes
  EXPECT_LT(peak("dempster,pcr2,pcr5,yager,pcr1,dsmh") - one_row, 60);
}

}  // namespace
}  // namespace evigrid::driver
