// SPDX-License-Identifier: Apache-2.0
// The ring of eight sonars: units, bearings, matching by time stamp, and the ways to name its files.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "error.hpp"
#include "log/readers.hpp"
#include "temp_dir.hpp"

namespace evigrid::driver {
namespace {

constexpr double kDeg = std::numbers::pi / 180;
constexpr const char* kPoses = "1000 0 0 0\n1200 1500 -250 900\n1400 3000 0 3600\n";
constexpr const char* kRanges =
    "1000 1000 1100 1200 1300 1400 1500 1600 5110\n"
    "1200 2000 5110 2200 2300 2400 2500 2600 2700\n"
    "1400 3000 3100 3200 3300 3400 3500 3600 3700\n";

struct Ring8 : ::testing::Test {
  TempDir dir;
  std::string poses = dir.write("poses.txt", kPoses), ranges = dir.write("measurement.txt", kRanges);
  [[nodiscard]] std::string folder() const { return dir.at(""); }
};

TEST_F(Ring8, UnitsPosesAndBearings) {
  const Log log = read_log({folder()}, "auto");
  EXPECT_EQ(log.format, "ring8");
  ASSERT_EQ(log.scans.size(), 3u);
  ASSERT_EQ(log.sensors.size(), 8u);
  EXPECT_EQ(log.scans[1].stamp_ns, 1'200'000'000);
  EXPECT_DOUBLE_EQ(log.scans[1].T_map_robot.x_m, 1.5);
  EXPECT_DOUBLE_EQ(log.scans[1].T_map_robot.y_m, -0.25);
  EXPECT_DOUBLE_EQ(log.scans[1].T_map_robot.yaw_rad, 90 * kDeg);
  EXPECT_DOUBLE_EQ(log.sensors[0].sensor.T_robot_sensor.yaw_rad, -90 * kDeg);
  EXPECT_DOUBLE_EQ(log.sensors[4].sensor.T_robot_sensor.yaw_rad, 7.5 * kDeg);
  EXPECT_DOUBLE_EQ(log.sensors[4].sensor.aperture_rad, 20 * kDeg);
  EXPECT_DOUBLE_EQ(log.sensors[4].sensor.max_range_m, 5.0);
  EXPECT_FLOAT_EQ(log.ranges_m[8], 2.0F);
  EXPECT_TRUE(std::isinf(log.ranges_m[7]));  // 5110
  EXPECT_TRUE(log.malformed.empty());
}

TEST_F(Ring8, EveryWayToNameItIsTheSame) {
  const Log whole = read_log({folder()}, "auto");
  for (const std::vector<std::string>& named : {std::vector{poses}, {ranges}, {poses, ranges}, {ranges, poses}}) {
    const Log log = read_log(named, "auto");
    EXPECT_EQ(log.ranges_m, whole.ranges_m) << named.front();
    EXPECT_EQ(log.scans.size(), whole.scans.size());
  }
}

TEST_F(Ring8, RowsAreMatchedByTimeStamp) {
  dir.write("poses.txt", "1400 3000 0 0\n1000 0 0 0\n");  // one missing, and in another order
  const Log log = read_log({folder()}, "ring8");
  ASSERT_EQ(log.scans.size(), 2u);
  EXPECT_DOUBLE_EQ(log.scans[1].T_map_robot.x_m, 3.0);
  EXPECT_EQ(log.malformed.at("no pose"), 1u);
}

TEST_F(Ring8, OfPosesWithOneTimeStampTheFirstComesFirst) {
  dir.write("poses.txt", "1200 1 0 0\n1000 2 0 0\n1200 3 0 0\n1200 4 0 0\n");
  const std::string row = " 900 900 900 900 900 900 900 900\n";
  dir.write("measurement.txt", "1200" + row + "1200" + row + "1000" + row + "1000" + row);
  const Log log = read_log({folder()}, "ring8");
  ASSERT_EQ(log.scans.size(), 3u);
  for (const auto& [scan, x_mm] : {std::pair{0u, 1}, {1u, 3}, {2u, 2}})
    EXPECT_DOUBLE_EQ(log.scans[scan].T_map_robot.x_m, x_mm / 1000.0);
  EXPECT_EQ(log.malformed.at("no pose"), 1u);
  EXPECT_EQ(log.malformed.at("no measurement"), 1u);
}

TEST_F(Ring8, BadRowsAreCountedAndTheRestUsed) {
  dir.write("measurement.txt", std::string("1000 1 2 3\n1200 2000 x 2200 2300 2400 2500 2600 2700\n") +
                                   "1400 nan -5 9999999 3300 3400 3500 3600 3700\n");
  const Log log = read_log({folder()}, "auto");
  ASSERT_EQ(log.scans.size(), 1u);
  EXPECT_EQ(log.malformed.at("too short"), 1u);
  EXPECT_EQ(log.malformed.at("bad number"), 1u);
  EXPECT_EQ(log.malformed.at("no measurement"), 2u);
  EXPECT_EQ(log.absurd_ranges, 1u);
  EXPECT_TRUE(std::isnan(log.ranges_m[0]) && std::isnan(log.ranges_m[2]));
  EXPECT_FLOAT_EQ(log.ranges_m[1], -0.005F);
}

TEST_F(Ring8, AMissingFileIsNamed) {
  std::filesystem::remove(poses);
  try {
    (void)read_log({ranges}, "auto");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_TRUE(contains(error.what(), "poses.txt: no such file"));
  }
}

}  // namespace
}  // namespace evigrid::driver
