// SPDX-License-Identifier: Apache-2.0
// Recorded logs, where they are at hand: counts that a second reader (awk) gave, and one map whoever computes it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;

std::string data(const std::string& name) { return std::string(EVIGRID_DATA_DIR) + "/" + name; }

#define NEED(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "missing recorded data: " << (path)

Json map_report(const std::string& log, std::vector<std::string> more = {}) {
  const TempDir dir;
  std::vector<std::string> all{"map", log, "-o", dir.at("out"), "--json", "-"};
  all.insert(all.end(), more.begin(), more.end());
  const Ran ran = evigrid(all);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return Json::parse(ran.out, nullptr, false);
}

struct Expected {
  const char* name;
  int scans, beams, no_return, backwards;
};

class LaserLog : public ::testing::TestWithParam<Expected> {};

TEST_P(LaserLog, CountsAsThePublishedLogHolds) {
  const Expected& want = GetParam();
  const std::string log = data(std::string("laser/ple-radish-corrected/") + want.name + "-corrected.log.gz");
  NEED(log);
  const Json r = map_report(log, {"--cell", "0.1"});
  EXPECT_EQ(r["scans"], want.scans);
  EXPECT_EQ(r["readings_used"], want.scans * want.beams - want.no_return);
  EXPECT_EQ(r["readings_refused"], Json({{"no_return", want.no_return}}));
  EXPECT_EQ(r["stamps_backwards"], want.backwards);
  EXPECT_EQ(r["records_malformed"], Json::object());
}

INSTANTIATE_TEST_SUITE_P(Radish, LaserLog,
                         ::testing::Values(Expected{"intel", 910, 180, 4172, 4},
                                           Expected{"freiburg-079", 4791, 360, 36004, 0},
                                           Expected{"aces", 440, 180, 620, 0}, Expected{"seattle", 241, 361, 707, 0},
                                           Expected{"orebro", 237, 181, 968, 0}),
                         [](const auto& one) { return "log" + std::to_string(one.index); });

TEST(RealLogs, SonarRing) {
  NEED(data("sonar/udacity-8ring/poses.txt"));
  const Json r = map_report(data("sonar/udacity-8ring/measurement.txt"));
  EXPECT_EQ(r["scans"], 206);
  std::uint64_t all = r["readings_used"];
  for (const auto& [reason, n] : r["readings_refused"].items()) all += n.get<std::uint64_t>();
  EXPECT_EQ(all, 206u * 8);
  EXPECT_EQ(r["records_malformed"], Json::object());
}

TEST(RealLogs, IntelIsOneMapWhoeverComputesIt) {
  const std::string log = data("laser/ple-radish-corrected/intel-corrected.log.gz");
  NEED(log);
  const Json one = map_report(log, {"--executor", "serial", "--kernel", "scalar"});
  const Json two = map_report(log, {"--threads", "2"});
  const Json seven = map_report(log, {"--threads", "7", "--executor", "openmp"});
  EXPECT_EQ(one["map_hash"], two["map_hash"]);
  EXPECT_EQ(one["map_hash"], seven["map_hash"]);
  EXPECT_EQ(one["threads"], 1);
  EXPECT_EQ(seven["concurrency"], 7);
}

}  // namespace
}  // namespace evigrid::driver
