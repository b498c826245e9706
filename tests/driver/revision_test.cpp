// SPDX-License-Identifier: Apache-2.0
// Learned revision: what it learns of a sensor of a known fault, its file, and the commands that make and use it.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "error.hpp"
#include "program.hpp"
#include "revision/train.hpp"
#include "text.hpp"

namespace evigrid::driver {
namespace {

Sensor sonar() {
  Sensor s;
  s.model = Model::li2014;
  return s;
}

/// A sensor that reads `bias_m` too far, with a little noise.
std::vector<Sample> biased(double bias_m, int count) {
  std::mt19937_64 random(7);
  std::vector<Sample> out;
  for (int i = 0; i < count; ++i) {
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    const double truth_m = 0.5 + 2 * uniform();
    out.push_back({truth_m, truth_m + bias_m + 0.01 * (uniform() - 0.5)});
  }
  return out;
}

TEST(Revision, ExamplesAreEmptyOccupiedAndUnknownByTheTrueRange) {
  const auto examples = examples_of(sonar(), {1.0, 1.2}, 0.05);
  ASSERT_GE(examples.size(), 6U);
  std::array<int, 3> by_truth{};
  for (const Example& e : examples) {
    EXPECT_NEAR(e.modelled[0] + e.modelled[1] + e.modelled[2] + e.modelled[3], 1, 1e-6);
    for (std::size_t i = 0; i < 3; ++i) by_truth[i] += e.truth[i] == 1;
  }
  EXPECT_GE(by_truth[0], 4);
  EXPECT_EQ(by_truth[1], 1);  // the cell of the true range
  EXPECT_GE(by_truth[2], 1);  // the one of the reading lies behind it
}

TEST(Revision, LearnsAKnownFaultAndBeatsTheConstant) {
  const Trained t = train(sonar(), biased(0.15, 400), {.examples = 800, .tries = 2});
  for (const std::size_t n : t.held_out) EXPECT_GT(n, 50U);
  EXPECT_LT(t.revised.rms, 0.9 * t.modelled.rms);
  EXPECT_LT(t.revised.rms, 0.9 * t.constant.rms);
  EXPECT_LT(t.constant.rms, t.always_occupied.rms);
  const Trained again = train(sonar(), biased(0.15, 400), {.examples = 800, .tries = 2});
  EXPECT_EQ(again.network.weight, t.network.weight);
}

TEST(Revision, AFileHoldsWeightsOfSaturatedNeuronsToo) {
  const TempDir dir;
  Revision r{0, "li2014", {}};
  r.network.weight[0] = 3e9, r.network.weight[30] = -Network::kMostWeight;
  EXPECT_EQ(read_revisions(dir.write("r.json", to_text({r})))[0].network.weight, r.network.weight);
  for (const double m : revise(r.network, Gbba{1, 0, 0, 0})) EXPECT_TRUE(m >= 0 && m <= 1) << m;
  r.network.weight[0] = 1e101;
  const std::string beyond = dir.write("beyond.json", to_text({r}));
  EXPECT_THROW((void)read_revisions(beyond), InputError);
}

TEST(Revision, GivesMasses) {
  const Trained t = train(sonar(), biased(0, 300), {.examples = 400, .tries = 1});
  for (const Gbba& in : {Gbba{1, 0, 0, 0}, Gbba{0, 1, 0, 0}, Gbba{0.2, 0.3, 0.1, 0.4}}) {
    const Gbba out = revise(t.network, in);
    double sum = 0;
    for (const double m : out) {
      EXPECT_GE(m, 0);
      sum += m;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST(Revision, TooFewReadingsAreRefused) { EXPECT_THROW((void)train(sonar(), biased(0, 5), {}), InputError); }

TEST(Revision, AFileGivesBackTheSameNetwork) {
  const TempDir dir;
  Revision r{3, "li2014", {}};
  for (std::size_t i = 0; i < r.network.weight.size(); ++i) r.network.weight[i] = std::sin(static_cast<double>(i)) / 3;
  const std::string path = dir.write("r.json", to_text({r}));
  const auto read = read_revisions(path);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].sensor, 3U);
  EXPECT_EQ(read[0].network.weight, r.network.weight);
  for (const char* bad : {"", "{}", "[1]", R"({"format":"evigrid revision 1","sensors":[]})",
                          R"({"format":"evigrid revision 1","sensors":[{"sensor":0,"model":"li2014","weights":[1]}]})",
                          R"({"format":"evigrid revision 1","sensors":[{"sensor":-1}]})"}) {
    EXPECT_THROW((void)read_revisions(dir.write("bad.json", bad)), InputError) << bad;
  }
}

TEST(Revision, FromSimulatedReadingsToRevisedMasses) {
  const TempDir dir;
  const Ran cast = evigrid({"cast", "--truth", "-o", dir.at("readings.csv")});
  ASSERT_EQ(cast.code, 0) << cast.err;
  const Ran ran = evigrid(
      {"train", dir.at("readings.csv"), "--together", "--examples", "800", "-o", dir.at("r.json"), "--json", "-"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto report = nlohmann::json::parse(ran.out);
  EXPECT_EQ(report["sensors"].size(), 1U);
  EXPECT_GT(report["sensors"][0]["held_out"][1], 50);
  const std::vector<std::string> ask{"model", "li2014", "--reading", "1.493", "--at", "1.5,0", "--at", "4,0"};
  std::vector<std::string> revised = ask;
  for (const std::string& word : {std::string("--revision"), dir.at("r.json")}) revised.push_back(word);
  const Ran before = evigrid(ask), after = evigrid(revised);
  ASSERT_EQ(after.code, 0) << after.err;
  EXPECT_NE(after.out, before.out);
  EXPECT_NE(after.out.find("4,0,0,0,1,0"), std::string::npos);  // outside the support nothing is revised
  const auto hash_of = [&](const std::vector<std::string>& more, const char* out) {
    std::vector<std::string> words{"run", "-o", dir.at(out), "--cell", "0.1", "--model", "li2014"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran run = evigrid(words);
    EXPECT_EQ(run.code, 0) << run.err;
    return nlohmann::json::parse(slurp(dir.at(std::string(out) + "/report.json")))["map_hash"].get<std::string>();
  };
  const std::string plain = hash_of({"--reliability", "1"}, "plain");
  const std::string with = hash_of({"--revision", dir.at("r.json")}, "with");
  EXPECT_NE(with, plain);
  EXPECT_EQ(hash_of({"--revision", dir.at("r.json"), "--kernel", "scalar", "--threads", "2"}, "again"), with);
  const auto refused = [&](std::vector<std::string> words, const char* why) {
    words.insert(words.begin(), {"run", "-o", dir.at("no"), "--revision", dir.at("r.json")});
    const Ran run = evigrid(words);
    EXPECT_EQ(run.code, 2) << why;
    EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
  };
  refused({"--model", "hughes1992"}, "revises li2014");
  refused({"--model", "li2014", "--rule", "bayes"}, "its cells hold no masses");
  revised[1] = "li2006";
  EXPECT_EQ(evigrid(revised).code, 2);
  EXPECT_EQ(evigrid({"train", dir.write("no.csv", "step,stamp_ns,sensor\n0,0,0\n"), "-o", dir.at("x.json")}).code, 2);
}

TEST(Revision, ABadRecordIsCountedAndToldAndTheRestUsed) {
  const TempDir dir;
  const std::string head = "step,stamp_ns,x_m,y_m,yaw_rad,sensor,range_m,truth\n";
  std::string good;
  int step = 0;
  for (const Sample& s : biased(0.1, 400))
    good += fmt::format("{},0,0,0,0,0,{:.9g},{:.9g}\n", step++, s.reading_m, s.truth_m);
  const std::string bad = "900,0,0,0,0,0,1.x,1\n901,0,0,0,0,-1,1,1\n902,0,0\n903,0,0,0,0,0.5,1,1\n";
  for (const std::string sensor : {"", "# sensor 0 kind=sonar model=li2014 aperture_rad=0.3 max_range_m=5\n"}) {
    const auto train = [&](const std::string& rows, const char* json) {
      return evigrid({"train", dir.write("d.csv", sensor + head + rows), "--examples", "400", "-o", dir.at("r.json"),
                      "--json", dir.at(json)});
    };
    ASSERT_EQ(train(good, "all.json").code, 0);
    const std::string network = slurp(dir.at("r.json"));
    const Ran ran = train(good + bad, "some.json");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(slurp(dir.at("r.json")), network);
    EXPECT_TRUE(contains(ran.out, "records_malformed: bad number")) << ran.out;
    const int first = sensor.empty() ? 402 : 403;
    EXPECT_TRUE(contains(ran.out, fmt::format("d.csv:{}: bad number: field 7 is '1.x'", first))) << ran.out;
    EXPECT_TRUE(contains(ran.out, fmt::format("d.csv:{}: unknown sensor", first + 1))) << ran.out;
    const auto report = nlohmann::json::parse(slurp(dir.at("some.json")));
    EXPECT_EQ(report["records_malformed"]["too short"], 1);
    EXPECT_EQ(report["warnings"].size(), 4U);
    EXPECT_EQ(nlohmann::json::parse(slurp(dir.at("all.json")))["records_malformed"], nlohmann::json::object());
    const Ran none = train(bad, "none.json");
    EXPECT_EQ(none.code, 2);
    EXPECT_TRUE(contains(none.err, "1.x")) << none.err;
  }
}

TEST(Revision, ReadingsComeThroughAPipeToo) {
  const TempDir dir;
  std::string rows = "step,stamp_ns,x_m,y_m,yaw_rad,sensor,range_m,truth\n";
  for (const Sample& s : biased(0.1, 20000)) rows += fmt::format("0,0,0,0,0,0,{:.9g},{:.9g}\n", s.reading_m, s.truth_m);
  const std::string pipe = dir.at("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << rows; });
  const Ran ran = evigrid({"train", pipe, "--examples", "400", "-o", dir.at("r.json"), "--json", "-"});
  writer.join();
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(nlohmann::json::parse(ran.out)["sensors"][0]["readings"], 20000);
}

}  // namespace
}  // namespace evigrid::driver
