// SPDX-License-Identifier: Apache-2.0
// evigrid cast: rows as they are cast, and nothing left of what could not be written.
#include <gtest/gtest.h>

#include "peak_memory.hpp"
#include "program.hpp"

namespace evigrid::driver {
namespace {

/// A laser of 181 beams that stands in a room.
std::string standing(int steps) {
  return R"([map]
cell_m = 0.1
rule = "pcr5"
[[world.polygons]]
vertices = [[0, 0], [6, 0], [6, 4], [0, 4]]
[robot]
use = "laser180"
[trajectory]
start = [1, 1]
period_s = 1
seed = 1
velocity = [{ speed_m_s = 0, duration_s = )" +
         std::to_string(steps) + " }]\n";
}

TEST(Cast, ALongRunTakesNoMoreMemoryThanAShortOne) {
  const TempDir dir;
  const std::string few = dir.write("few.toml", standing(40)), many = dir.write("many.toml", standing(4000));
  for (const bool to_file : {false, true}) {
    const auto peak = [&](const std::string& scene) {
      std::vector<std::string> line{"cast", scene, "--truth", "--threads", "1"};
      if (to_file) line.insert(line.end(), {"-o", dir.at("out.csv")});
      return peak_mb(line);
    };
    const double of_few = peak(few);
    EXPECT_LT(peak(many) - of_few, 20);
  }
  EXPECT_GT(std::filesystem::file_size(dir.at("out.csv")), 30'000'000U);
}

TEST(Cast, TheFileHoldsWhatStandardOutputGets) {
  const TempDir dir;
  const Ran shown = evigrid({"cast", "--truth", "--sensors"});
  ASSERT_EQ(evigrid({"cast", "--truth", "--sensors", "-o", dir.at("out.csv")}).code, 0);
  EXPECT_EQ(slurp(dir.at("out.csv")), shown.out);
  EXPECT_EQ(dir.names(), std::set<std::string>{"out.csv"});
}

TEST(Cast, AFullDeviceIsTold) {
  const Ran full = evigrid({"cast", "-o", "/dev/full"});
  EXPECT_EQ(full.code, 2);
  EXPECT_TRUE(contains(full.err, "/dev/full: cannot be written"));
}

TEST(Cast, ARobotThatStandsStillIsTold) {
  const TempDir dir;
  const Ran ran = evigrid({"cast", dir.write("stands.toml", standing(0))});
  EXPECT_EQ(ran.code, 0);
  EXPECT_TRUE(contains(ran.err, "warning: the robot stands still"));
}

}  // namespace
}  // namespace evigrid::driver
