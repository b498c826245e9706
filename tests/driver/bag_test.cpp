// SPDX-License-Identifier: Apache-2.0
// ROS bags: written here by rosbag itself, read by evigrid.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "bag/bag.hpp"
#include "bag_writer.hpp"
#include "error.hpp"
#include "evigrid/evigrid.hpp"
#include "log/readers.hpp"
#include "program.hpp"
#include "ros_bag/bag.hpp"
#include "ros_bag/check.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;
using testing::BagWriter;
constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kT = 1.7e9;  // s

/// map ─► odom ─► base_link on tf every half second while the robot drives along x at 1 m/s, and two mounts.
void drive(BagWriter& bag, double seconds, bool with_map = true) {
  bag.transform(kT, "base_link", "laser", {0.2, 0.1, 0.3, 0, 0, 0.5}, true);
  bag.transform(kT, "base_link", "sonar", {-0.1, 0, 0.3, 0, 0, M_PI / 2}, true);
  for (double t = 0; t <= seconds; t += 0.5) {
    if (with_map) bag.transform(kT + t, "map", "odom", {1, 2, 0, 0, 0, M_PI / 2});
    bag.transform(kT + t, "odom", "base_link", {t, 0, 0, 0, 0, 0});
  }
}

TEST(RosBag, LasersAndSonarsWithTheirFrames) {
  const TempDir dir;
  BagWriter bag(dir.at("a.bag"));
  drive(bag, 3);
  bag.text(kT, "/chatter", "hello");
  bag.laser(kT + 0.25, "/scan", "laser", -1, 0.5F, {1, 2, kInf, 3, kNan});
  bag.laser(kT + 1.25, "/scan", "/laser", -1, 0.5F, {1, 2, -kInf, 3, 20});
  bag.range(kT + 1, "/us0", "sonar", 1.5F);
  bag.close();
  const Log log = read_log({dir.at("a.bag")}, "auto");
  EXPECT_EQ(log.format, "bag");
  EXPECT_EQ(log.poses, Poses::recorded);
  ASSERT_EQ(log.sensors.size(), 2U);
  ASSERT_EQ(log.scans.size(), 3U);
  EXPECT_TRUE(log.malformed.empty());
  EXPECT_EQ(log.skipped.at("std_msgs/Header"), 1U);
  const Sensor &laser = log.sensors[0].sensor, &sonar = log.sensors[1].sensor;
  EXPECT_EQ(log.sensors[0].name, "/scan");
  EXPECT_EQ(laser.model, Model::beam);
  EXPECT_EQ(laser.beams, 5);
  EXPECT_DOUBLE_EQ(laser.first_beam_rad, -1);
  EXPECT_DOUBLE_EQ(laser.beam_step_rad, 0.5);
  EXPECT_EQ(laser.max_range_m, 10);
  EXPECT_NEAR(laser.T_robot_sensor.x_m, 0.2, 1e-12);
  EXPECT_NEAR(laser.T_robot_sensor.y_m, 0.1, 1e-12);
  EXPECT_NEAR(laser.T_robot_sensor.yaw_rad, 0.5, 1e-12);
  EXPECT_NE(sonar.model, Model::beam);
  EXPECT_NEAR(sonar.aperture_rad, 0.3, 1e-6);
  EXPECT_EQ(sonar.max_range_m, 4);
  // In the order of their stamps; poses between two transforms: map is turned by 90° from odom.
  EXPECT_EQ(log.scans[0].stamp_ns, 1'700'000'000'250'000'000);
  EXPECT_EQ(log.readings[log.scans[1].first].sensor, 1U);
  EXPECT_NEAR(log.scans[0].T_map_robot.x_m, 1, 1e-6);
  EXPECT_NEAR(log.scans[0].T_map_robot.y_m, 2.25, 1e-6);
  EXPECT_NEAR(log.scans[2].T_map_robot.y_m, 3.25, 1e-6);
  EXPECT_NEAR(log.scans[0].T_map_robot.yaw_rad, M_PI / 2, 1e-9);
  EXPECT_EQ(log.ranges_m[2], kInf);
  EXPECT_TRUE(std::isnan(log.ranges_m[4]));
}

/// REP 117 to the end: what the map makes of it.
TEST(RosBag, NoReturnTooCloseAndInvalidAreTold) {
  const TempDir dir;
  BagWriter bag(dir.at("a.bag"));
  drive(bag, 1);
  bag.laser(kT + 0.5, "/scan", "laser", -1, 0.5F, {1, kInf, -kInf, kNan, 0.05F, 12});
  bag.close();
  const auto map = [&](std::vector<std::string> more) {
    std::vector<std::string> all{"map", dir.at("a.bag"), "-o", dir.at("out"), "--json", "-"};
    all.insert(all.end(), more.begin(), more.end());
    const Ran ran = evigrid(all);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return Json::parse(ran.out);
  };
  const Json report = map({});
  EXPECT_EQ(report["readings_used"], 1);
  EXPECT_EQ(report["readings_refused"], (Json{{"no_return", 2}, {"too_close", 2}, {"not_a_number", 1}}));
  const Json clearing = map({"--clear-no-return"});  // nothing within range: a reading of the largest
  EXPECT_EQ(clearing["readings_used"], 3);
  EXPECT_EQ(clearing["readings_refused"], (Json{{"too_close", 2}, {"not_a_number", 1}}));
  EXPECT_GT(clearing["cells_updated"], report["cells_updated"]);
}

TEST(RosBag, AnUpsideDownOrClockwiseLaserIsTheSameLaser) {
  const TempDir dir;
  const std::vector<float> ranges{1, 1.5F, 2, 2.5F};
  for (int kind = 0; kind < 3; ++kind) {
    BagWriter bag(dir.at("a.bag"));
    bag.transform(kT, "base_link", "laser", {0.2, 0, 0, kind == 1 ? M_PI : 0, 0, 0}, true);
    for (double t = 0; t < 2; ++t) bag.transform(kT + t, "map", "base_link", {0, 0, 0, 0, 0, 0.25});
    const std::vector<float> turned(ranges.rbegin(), ranges.rend());
    if (kind == 0) bag.laser(kT + 0.5, "/scan", "laser", -0.75F, 0.5F, ranges);
    if (kind == 1) bag.laser(kT + 0.5, "/scan", "laser", -0.75F, 0.5F, turned);
    if (kind == 2) bag.laser(kT + 0.5, "/scan", "laser", 0.75F, -0.5F, turned);
    bag.close();
    const Log log = read_log({dir.at("a.bag")}, "bag");
    ASSERT_EQ(log.ranges_m, ranges) << kind;
    EXPECT_NEAR(log.sensors[0].sensor.first_beam_rad, -0.75, 1e-6);
    EXPECT_NEAR(log.sensors[0].sensor.beam_step_rad, 0.5, 1e-6);
    EXPECT_NEAR(log.sensors[0].sensor.T_robot_sensor.yaw_rad, 0, 1e-9);
  }
}

TEST(RosBag, WithoutMapTheOdometryCarriesThePoses) {
  const TempDir dir;
  for (const bool tf : {true, false}) {
    BagWriter bag(dir.at("a.bag"));
    if (tf) {
      drive(bag, 2, false);
    } else {
      bag.transform(kT, "base_link", "laser", {0.2, 0.1, 0.3, 0, 0, 0.5}, true);
      for (double t = 0; t <= 2; t += 0.5) bag.odometry(kT + t, "odom", "base_link", t, 0, 0);
    }
    bag.laser(kT + 1.75, "/scan", "laser", -1, 0.5F, {1, 2});
    bag.close();
    const Log log = read_log({dir.at("a.bag")}, "auto");
    EXPECT_EQ(log.poses, Poses::dead_reckoned);
    ASSERT_EQ(log.scans.size(), 1U);
    EXPECT_NEAR(log.scans[0].T_map_robot.x_m, 1.75, 1e-6);
    EXPECT_NEAR(log.scans[0].T_map_robot.y_m, 0, 1e-9);
  }
}

TEST(RosBag, FramesAndTopicsByName) {
  const TempDir dir;
  BagWriter bag(dir.at("a.bag"));
  bag.transform(kT, "base_footprint", "laser", {0, 0, 0, 0, 0, 0}, true);
  for (double t = 0; t < 3; ++t) bag.transform(kT + t, "world", "base_footprint", {t, 0, 0, 0, 0, 0});
  bag.laser(kT + 1, "/front", "laser", -1, 0.5F, {1, 2});
  bag.laser(kT + 1, "/back", "laser", -1, 0.5F, {3, 4});
  bag.close();
  EXPECT_THROW((void)read_log({dir.at("a.bag")}, "auto"), InputError);  // no base_link
  const Log log = read_log({dir.at("a.bag")}, "auto", {"base_footprint", "world", {"/back"}});
  ASSERT_EQ(log.scans.size(), 1U);
  EXPECT_EQ(log.ranges_m, (std::vector<float>{3, 4}));
  EXPECT_NEAR(log.scans[0].T_map_robot.x_m, 1, 1e-9);
  const Ran ran = evigrid({"map", dir.at("a.bag"), "-o", dir.at("out"), "--base-frame", "base_footprint",
                           "--fixed-frame", "world", "--topics", "/front,/back"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  const Ran bad = evigrid({"map", dir.at("a.bag"), "-o", dir.at("bad"), "--base-frame", "base_footprint"});
  EXPECT_EQ(bad.code, 2);
  EXPECT_TRUE(contains(bad.err, "names the frame 'odom'")) << bad.err;
}

TEST(RosBag, WhatCannotBeUsedIsCountedByReason) {
  const TempDir dir;
  BagWriter bag(dir.at("a.bag"));
  drive(bag, 2);
  bag.transform(kT, "base_link", "leaning", {0, 0, 0, 0, 0.9, 0}, true);
  bag.laser(kT + 1, "/scan", "laser", -1, 0.5F, {1, 2});
  bag.laser(kT + 50, "/scan", "laser", -1, 0.5F, {1, 2});   // tf ends before
  bag.laser(kT + 1, "/scan", "nowhere", -1, 0.5F, {1, 2});  // no such frame
  bag.laser(kT + 1, "/scan", "leaning", -1, 0.5F, {1, 2});
  bag.laser(kT + 1, "/scan", "laser", -1, 0, {1, 2});  // no step
  bag.laser(kT + 1, "/scan", "laser", kNan, 0.5F, {1, 2});
  bag.laser(kT + 1, "/scan", "laser", -1, 0.5F, {});
  bag.range(kT + 1, "/us0", "sonar", 1.5F, 3);  // three radians wide
  bag.close();
  const Log log = read_log({dir.at("a.bag")}, "auto");
  EXPECT_EQ(log.scans.size(), 1U);
  const std::map<std::string, std::uint64_t> wanted{
      {"no transform", 2}, {"tilted", 1}, {"bad geometry", 3}, {"wrong count", 1}};
  EXPECT_EQ(log.malformed, wanted);
}

TEST(RosBag, CompressedChunksAreTheSame) {
  const TempDir dir;
  std::vector<std::vector<float>> ranges;
  for (const auto packed : {BagWriter::Packed::no, BagWriter::Packed::bz2, BagWriter::Packed::lz4}) {
    BagWriter bag(dir.at("a.bag"), packed);
    drive(bag, 30);
    for (int i = 0; i < 50; ++i)
      bag.laser(kT + 0.5 * i, "/scan", "laser", -1, 0.01F, std::vector<float>(200, 1 + 0.1F * static_cast<float>(i)));
    bag.close();
    const Log log = read_log({dir.at("a.bag")}, "auto");
    EXPECT_EQ(log.scans.size(), 50U);
    ranges.push_back(log.ranges_m);
  }
  EXPECT_EQ(ranges[0], ranges[1]);
  EXPECT_EQ(ranges[0], ranges[2]);
}

TEST(RosBag, AFlippedByteIsAnErrorOrALog) {
  const TempDir dir;
  BagWriter bag(dir.at("a.bag"));
  drive(bag, 2);
  bag.laser(kT + 1, "/scan", "laser", -1, 0.5F, {1, 2});
  bag.close();
  const std::string whole = slurp(dir.at("a.bag"));
  int errors = 0, tries = 0;
  for (std::size_t at = 0; at < whole.size(); at += 37, ++tries) {
    std::string bad = whole;
    bad[at] = static_cast<char>(bad[at] ^ 0x80);
    try {
      (void)read_log({dir.write("bad.bag", bad)}, "bag");
    } catch (const InputError&) {
      ++errors;
    }
  }
  EXPECT_GT(errors, 20);
  EXPECT_LT(errors, tries);  // most bytes are padding and definitions
}

TEST(RosBag, CountsBeyondTheMessageAreSeen) {
  const auto fits = [](const char* type, std::vector<std::uint32_t> words) {
    return ros_bag::counts_fit(type, reinterpret_cast<const std::uint8_t*>(words.data()), 4 * words.size());
  };
  EXPECT_TRUE(fits("tf2_msgs/TFMessage", {0}));
  EXPECT_FALSE(fits("tf2_msgs/TFMessage", {1'000'000'000}));
  EXPECT_FALSE(fits("tf2_msgs/TFMessage", {}));
  // Header without a frame, seven floats, counts of ranges and of intensities.
  EXPECT_TRUE(fits("sensor_msgs/LaserScan", {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 2, 8, 9, 0}));
  EXPECT_FALSE(fits("sensor_msgs/LaserScan", {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 4, 8, 9, 0}));
  EXPECT_FALSE(fits("sensor_msgs/LaserScan", {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 2, 8, 9, 7}));
  EXPECT_FALSE(fits("sensor_msgs/LaserScan", {0, 0, 0, 99, 1, 2, 3, 4, 5, 6, 7, 2, 8, 9, 0}));
}

TEST(RosBag, DamageIsAnError) {
  const TempDir dir;
  BagWriter bag(dir.at("a.bag"));
  drive(bag, 2);
  bag.laser(kT + 1, "/scan", "laser", -1, 0.5F, {1, 2});
  bag.close();
  const std::string whole = slurp(dir.at("a.bag"));
  for (const std::size_t n : {std::size_t{13}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    const std::string file = dir.write("cut.bag", whole.substr(0, n));
    try {
      (void)read_log({file}, "auto");
      FAIL() << n;
    } catch (const InputError& bad) {
      EXPECT_TRUE(std::string(bad.what()).starts_with(file)) << bad.what();
    }
  }
  EXPECT_THROW((void)read_log({dir.at("none.bag")}, "bag"), InputError);
  EXPECT_THROW((void)read_log({dir.write("text.bag", "no bag")}, "bag"), InputError);
  BagWriter(dir.at("empty.bag")).close();
  EXPECT_THROW((void)read_log({dir.at("empty.bag")}, "auto"), InputError);
}

TEST(RosBag, AMapAsAnOccupancyGrid) {
  const TempDir dir;
  BagWriter bag(dir.at("a.bag"));
  drive(bag, 2);
  for (double t = 0.5; t < 2; t += 0.25) bag.laser(kT + t, "/scan", "laser", -1, 0.02F, std::vector<float>(100, 2.5F));
  bag.close();
  ASSERT_EQ(evigrid({"map", dir.at("a.bag"), "-o", dir.at("out")}).code, 0);
  const Ran ran = evigrid({"export", dir.at("out"), "-o", dir.at("grid.bag"), "--topic", "/house", "--frame", "world",
                           "--occupied", "0.7", "--free", "0.2"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Map map = load(dir.at("out") + "/map.evigrid");
  const ros_bag::Grid grid = ros_bag::read_grid(dir.at("grid.bag"), "/house");
  const CellRect b = map.bounds();
  EXPECT_EQ(grid.frame, "world");
  EXPECT_EQ(grid.stamp_ns, 1'700'000'001'750'000'000);
  EXPECT_EQ(grid.width, b.width);
  EXPECT_EQ(grid.height, b.height);
  EXPECT_NEAR(grid.resolution_m, 0.05, 1e-9);
  EXPECT_NEAR(grid.x_m, static_cast<double>(b.x) * 0.05, 1e-12);
  EXPECT_NEAR(grid.y_m, static_cast<double>(b.y) * 0.05, 1e-12);
  std::size_t occupied = 0;
  for (std::int64_t y = 0; y < b.height; ++y) {
    for (std::int64_t x = 0; x < b.width; ++x) {
      const std::int8_t got = grid.data[static_cast<std::size_t>(y * b.width + x)];
      ASSERT_EQ(got, occupancy_of({0.2, 0.7, 0.9}, map.mass({b.x + x, b.y + y})));
      occupied += got == 100;
    }
  }
  EXPECT_GT(occupied, 10U);
}

}  // namespace
}  // namespace evigrid::driver
