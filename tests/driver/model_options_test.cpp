// SPDX-License-Identifier: Apache-2.0
// Models on the command line and in scenes: parameters, pairs that do not fit, filters.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.hpp"
#include "temp_dir.hpp"
#include "text.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;

std::string scene(const std::string& sensor, const std::string& map = "") {
  return "[map]\ncell_m = 0.1\nrule = \"pcr5\"\n" + map +
         "[[world.polygons]]\nvertices = [[0, 0], [6, 0], [6, 4], [0, 4]]\n"
         "[robot]\nuse = \"hughes24\"\n" +
         sensor + "[trajectory]\nwaypoints = [[1, 1], [5, 1], [5, 3]]\nseed = 3\n";
}
Json run_of(const TempDir& dir, const std::string& text, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"run", dir.write("s.toml", text), "-o", dir.at("out"), "--json", "-"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Ran ran = evigrid(arguments);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return ran.code == 0 ? Json::parse(ran.out) : Json();
}

TEST(ModelCommand, EveryConeModelAnswers) {
  for (const std::string model :
       {"hughes1992", "oriolo1997", "li2006", "li2014", "probability", "fuzzy", "moravec1985"}) {
    const Ran ran = evigrid({"model", model, "--reading", "1.5", "--at", "1.2,0", "--at", "1.5,3"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_TRUE(starts_with(ran.out, "d_m,theta_deg,e,o,u,c\n1.2,0,")) << ran.out;
    EXPECT_FALSE(contains(ran.out, "1.2,0,0,0,1,0")) << model;
  }
  const Ran raw = evigrid({"model", "li2006", "--reading", "1.5", "--at", "1.6,0", "--param", "epsilon_m=0.05"});
  EXPECT_TRUE(contains(raw.out, "1.6,0,0,0,1,0")) << raw.out;  // behind R + ε
  const Ran wide = evigrid({"model", "li2006", "--reading", "1.5", "--at", "1.6,0", "--param", "li2006.epsilon_m=0.2"});
  EXPECT_FALSE(contains(wide.out, "1.6,0,0,0,1,0")) << wide.out;
}

TEST(ModelOptions, BadOnesAreNamed) {
  const auto refused = [](std::vector<std::string> more, const std::string& word) {
    std::vector<std::string> arguments{"model", "li2006", "--reading", "1.5", "--at", "1,0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = evigrid(arguments);
    EXPECT_EQ(ran.code, 2);
    EXPECT_TRUE(contains(ran.err, word)) << ran.err;
  };
  refused({"--param", "epsilon=1"}, "epsilon_m");
  refused({"--param", "epsilon_m=9"}, "within [0, 2]");
  refused({"--param", "epsilon_m"}, "MODEL.NAME=VALUE");
  refused({"--param", "fuzzy.epsilon_m=0.2"}, "no sensor here");
  refused({"--param", "discount_by_lambda=0.5"}, "true");
  refused({"--cell", "0"}, "--cell");
  const TempDir dir;
  const auto run_refused = [&](std::vector<std::string> more, const std::string& word) {
    std::vector<std::string> arguments{"run", dir.write("s.toml", scene("")), "-o", dir.at("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = evigrid(arguments);
    EXPECT_EQ(ran.code, 2);
    EXPECT_TRUE(contains(ran.err, word)) << ran.err;
  };
  run_refused({"--model", "probability"}, "its rule is bayes");
  run_refused({"--model", "fuzzy", "--rule", "bayes"}, "its rule is fuzzy");
  run_refused({"--param", "epsilon_m=0.1"}, "does not name its model");
  run_refused({"--param", "li2006.epsilon_m=0.1"}, "no sensor here");
  run_refused({"--filter", "median"}, "false_reflection");
  run_refused({"--filter", "false_reflection=-1"}, "false_reflection");
}

TEST(ModelOptions, ASceneSaysTheSameAsTheCommandLine) {
  const TempDir dir;
  const Json plain = run_of(dir, scene("[robot.sensor]\nmodel = \"li2006\"\n"));
  const Json by_scene = run_of(dir, scene("[robot.sensor]\nmodel = \"li2006\"\n[robot.sensor.li2006]\nepsilon_m = 0.3\n"
                                          "discount_by_lambda = false\n"));
  const Json by_line = run_of(dir, scene("[robot.sensor]\nmodel = \"li2006\"\n"),
                              {"--param", "li2006.epsilon_m=0.3", "--param", "li2006.discount_by_lambda=false"});
  EXPECT_EQ(by_scene["map_hash"], by_line["map_hash"]);
  EXPECT_NE(by_scene["map_hash"], plain["map_hash"]);
  const Ran wrong =
      evigrid({"run", dir.write("w.toml", scene("[robot.sensor.li2006]\nepsilon = 0.3\n")), "-o", dir.at("o")});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_TRUE(contains(wrong.err, "robot.sensor.li2006.epsilon")) << wrong.err;
  const Ran range =
      evigrid({"run", dir.write("r.toml", scene("[robot.sensor.li2006]\nepsilon_m = 3\n")), "-o", dir.at("o")});
  EXPECT_EQ(range.code, 2);
  EXPECT_TRUE(contains(range.err, "epsilon_m")) << range.err;
}

TEST(ModelOptions, TheFilterDropsAndCounts) {
  const TempDir dir;
  const Json by_line = run_of(dir, scene(""), {"--filter", "false_reflection=0.02"});
  const Json by_scene = run_of(dir, scene("", "false_reflection_m = 0.02\n"));
  EXPECT_GT(by_line["readings_refused"]["false_reflection"], 100);
  EXPECT_EQ(by_line["map_hash"], by_scene["map_hash"]);
  EXPECT_EQ(run_of(dir, scene("", "false_reflection_m = 0.02\n"), {"--filter", "none"})["map_hash"],
            run_of(dir, scene(""))["map_hash"]);
}

TEST(ModelOptions, CompareTakesThePairsThatFit) {
  const TempDir dir;
  const Ran ran =
      evigrid({"compare", dir.write("s.toml", scene("")), "-o", dir.at("out"), "--rules", "pcr5,bayes,fuzzy",
               "--models", "li2006,probability,fuzzy,moravec1985", "--param", "li2006.epsilon_m=0.2", "--json", "-"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  std::set<std::string> pairs;
  const Json report = Json::parse(ran.out);
  for (const Json& row : report["rows"]) {
    pairs.insert(row["rule"].get<std::string>() + ' ' + row["model"].get<std::string>());
    EXPECT_GT(row["score"]["within_one_cell"]["precision"], 0.2) << row.dump();
  }
  EXPECT_EQ(pairs, (std::set<std::string>{"pcr5 li2006", "bayes li2006", "fuzzy li2006", "bayes probability",
                                          "fuzzy fuzzy", "fuzzy moravec1985"}));
  const Ran none = evigrid({"compare", dir.at("s.toml"), "-o", dir.at("no"), "--rules", "pcr5", "--models", "fuzzy"});
  EXPECT_EQ(none.code, 2);
  EXPECT_TRUE(contains(none.err, "cannot be fused by pcr5")) << none.err;
}

}  // namespace
}  // namespace evigrid::driver
