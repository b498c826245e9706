// SPDX-License-Identifier: Apache-2.0
// The CARMEN reader: every keyword, every kind of damage, plain and gzip.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "error.hpp"
#include "log/readers.hpp"
#include "records.hpp"
#include "temp_dir.hpp"

namespace evigrid::driver {
namespace {

constexpr double kDeg = std::numbers::pi / 180;

Log read_text(const std::string& text) {
  const TempDir dir;
  return read_log({dir.write("a.log", text)}, "auto");
}

std::string error_of(const std::vector<std::string>& paths, const std::string& format = "auto") {
  try {
    (void)read_log(paths, format);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(no error)";
}

TEST(Carmen, FlaserHasPoseStampAndRanges) {
  const Log log = read_text(flaser_with(180, 7, "4.25", 12.5));
  ASSERT_EQ(log.scans.size(), 1u);
  EXPECT_EQ(log.format, "carmen");
  EXPECT_EQ(log.scans[0].stamp_ns, 12'500'000'000);
  EXPECT_EQ(log.ranges_m.size(), 180u);
  EXPECT_FLOAT_EQ(log.ranges_m[6], 3.5F);
  EXPECT_FLOAT_EQ(log.ranges_m[7], 4.25F);
  const Log posed = read_text(flaser(180, "3", 1, "1.5 -2.5 0.75"));
  EXPECT_DOUBLE_EQ(posed.scans[0].T_map_robot.x_m, 1.5);
  EXPECT_DOUBLE_EQ(posed.scans[0].T_map_robot.y_m, -2.5);
  EXPECT_DOUBLE_EQ(posed.scans[0].T_map_robot.yaw_rad, 0.75);
}

TEST(Carmen, StepFollowsTheNumberOfBeams) {
  for (const auto& [n, step_deg] : {std::pair{180, 1.0}, {181, 1.0}, {360, 0.5}, {361, 0.5}, {90, 2.0}}) {
    const Log log = read_text(flaser(n, "3", 1));
    const Sensor& s = log.sensors.at(0).sensor;
    EXPECT_EQ(s.beams, n);
    EXPECT_DOUBLE_EQ(s.beam_step_rad, step_deg * kDeg) << n;
    EXPECT_DOUBLE_EQ(s.first_beam_rad, -90 * kDeg);
  }
}

TEST(Carmen, OneSensorForEachKindAndNumberOfBeams) {
  const Log log = read_text(flaser(180, "3", 1) + flaser(180, "3", 2) + flaser(181, "3", 3) +
                            flaser(180, "3", 4, "0 0 3", "RLASER") + robotlaser(180, -1.5, 0.01, 1, 5));
  ASSERT_EQ(log.sensors.size(), 4u);
  EXPECT_EQ(log.sensors[2].kind, "RLASER");
  EXPECT_EQ(log.sensors[3].kind, "ROBOTLASER1");
  EXPECT_EQ(log.scans.size(), 5u);
}

TEST(Carmen, RobotlaserTakesTheLasersPoseAndStatedGeometry) {
  const Log log = read_text(robotlaser(5, -0.5, 0.25, 2, 3, 4));
  ASSERT_EQ(log.scans.size(), 1u);
  const Sensor& s = log.sensors[0].sensor;
  EXPECT_DOUBLE_EQ(s.first_beam_rad, -0.5);
  EXPECT_DOUBLE_EQ(s.beam_step_rad, 0.25);
  EXPECT_DOUBLE_EQ(s.no_return_m, 50);
  EXPECT_DOUBLE_EQ(log.scans[0].T_map_robot.x_m, 4);  // 9 is the robot's
  EXPECT_EQ(log.scans[0].stamp_ns, 3'000'000'000);
  EXPECT_FLOAT_EQ(log.ranges_m[4], 6);
}

TEST(Carmen, ClockwiseBeamsAreTurnedRound) {
  const Log log = read_text(robotlaser(5, 0.5, -0.25, 2, 3));
  const Sensor& s = log.sensors.at(0).sensor;
  EXPECT_DOUBLE_EQ(s.first_beam_rad, -0.5);
  EXPECT_DOUBLE_EQ(s.beam_step_rad, 0.25);
  EXPECT_FLOAT_EQ(log.ranges_m.front(), 6);
  EXPECT_FLOAT_EQ(log.ranges_m.back(), 2);
}

TEST(Carmen, OtherRecordsAreCountedByKeyword) {
  const Log log =
      read_text("# note\nPARAM a 1\nPARAM b 2\nODOM 0 0 0 0 0 0 1 h 1\nNEFF 1\nHELLO x\n\n" + flaser(180, "3", 1));
  EXPECT_EQ(log.skipped.at("#"), 1u);
  EXPECT_EQ(log.skipped.at("PARAM"), 2u);
  EXPECT_EQ(log.skipped.at("ODOM"), 1u);
  EXPECT_EQ(log.skipped.at("HELLO"), 1u);
  EXPECT_TRUE(log.malformed.empty());
}

TEST(Carmen, KeywordsOfANonsenseFileStayBounded) {
  std::string text = flaser(180, "3", 1);
  for (int i = 0; i < 1000; ++i) text += fmt::format("word{} 1\n", i);
  const Log log = read_text(text);
  EXPECT_LE(log.skipped.size(), 65u);
  EXPECT_GT(log.skipped.at("(other)"), 900u);
}

TEST(Carmen, MalformedRecordsAreCountedAndTheRestUsed) {
  const std::string good = flaser(180, "3", 1);
  std::string wrong_count = good, too_short = good.substr(0, 200) + "\n", no_number = flaser_with(180, 9, "3.x", 2);
  wrong_count[wrong_count.find("180") + 1] = '7';
  std::string one_short = good;
  one_short[one_short.find("180") + 2] = '1';
  const Log log = read_text(good + wrong_count + too_short + no_number + one_short +
                            "FLASER\nFLASER -3 1\nFLASER 1e300 1\n" + flaser(4, "3", 1) + good);
  EXPECT_EQ(log.scans.size(), 2u);
  EXPECT_EQ(log.malformed.at("wrong count"), 3u);
  EXPECT_EQ(log.malformed.at("too short"), 3u);
  EXPECT_EQ(log.malformed.at("bad number"), 1u);
  EXPECT_EQ(log.malformed.at("unusable geometry"), 1u);  // 4 beams, 45° apart
  ASSERT_FALSE(log.warnings.empty());
  EXPECT_TRUE(contains(log.warnings[0], "a.log:2: wrong count"));
}

TEST(Carmen, OddRangesReachTheEngineToBeCounted) {
  const Log log =
      read_text(flaser_with(180, 1, "nan", 1) + flaser_with(180, 1, "inf", 2) + flaser_with(180, 1, "-inf", 3) +
                flaser_with(180, 1, "-2", 4) + flaser_with(180, 1, "54321", 5));
  ASSERT_EQ(log.scans.size(), 5u);
  const auto beam1 = [&](std::size_t scan) { return log.ranges_m[scan * 180 + 1]; };
  EXPECT_TRUE(std::isnan(beam1(0)));
  EXPECT_TRUE(std::isinf(beam1(1)) && beam1(1) > 0);
  EXPECT_TRUE(std::isinf(beam1(2)) && beam1(2) < 0);
  EXPECT_FLOAT_EQ(beam1(3), -2);
  EXPECT_TRUE(std::isnan(beam1(4)));
  EXPECT_EQ(log.absurd_ranges, 1u);
}

TEST(Carmen, ANumberThatNoFloatHoldsIsAbsurdToo) {
  const Log log = read_text(flaser_with(180, 1, "1e39", 1) + flaser_with(180, 2, "1e308", 2));
  ASSERT_EQ(log.scans.size(), 2u);
  EXPECT_TRUE(std::isnan(log.ranges_m[1]));
  EXPECT_TRUE(std::isnan(log.ranges_m[182]));
  EXPECT_EQ(log.absurd_ranges, 2u);
}

TEST(Carmen, NoReturnIsThePlateauAtTheTop) {
  const Log codes = read_text(flaser_with(180, 1, "81.91", 1) + flaser_with(180, 2, "81.87", 2));
  EXPECT_NEAR(codes.sensors[0].sensor.no_return_m, 81.86, 1e-4);
  const Log lone = read_text(flaser_with(180, 1, "25.3", 1));
  EXPECT_DOUBLE_EQ(lone.sensors[0].sensor.no_return_m, 1000);
  const Log near = read_text(flaser(180, "3.5", 1));  // a plateau, but a real wall
  EXPECT_DOUBLE_EQ(near.sensors[0].sensor.no_return_m, 1000);
  const Log absurd = read_text(flaser_with(180, 1, "50000", 1) + flaser(180, "30", 2));
  EXPECT_NEAR(absurd.sensors[0].sensor.no_return_m, 29.95, 1e-4);
}

TEST(Carmen, TimeBackwardsKeepsTheLineOrder) {
  const Log log = read_text(flaser(180, "3", 5) + flaser(180, "3", 4));
  ASSERT_EQ(log.scans.size(), 2u);
  EXPECT_GT(log.scans[0].stamp_ns, log.scans[1].stamp_ns);
}

TEST(Carmen, LineEndsOfWindowsAndAMissingLastOne) {
  std::string text = flaser(180, "3", 1) + flaser(180, "3", 2);
  text.insert(text.find('\n'), 1, '\r');
  text.pop_back();
  EXPECT_EQ(read_text(text).scans.size(), 2u);
}

TEST(Carmen, GzipGivesTheSameLog) {
  const TempDir dir;
  std::string text;
  for (int i = 0; i < 500; ++i) text += flaser_with(361, i % 361, "4.5", i);  // larger than one buffer
  const Log plain = read_log({dir.write("a.log", text)}, "auto");
  const Log packed = read_log({dir.write_gz("a.log.gz", text)}, "auto");
  ASSERT_EQ(plain.scans.size(), 500u);
  EXPECT_EQ(packed.scans.size(), 500u);
  EXPECT_EQ(plain.ranges_m, packed.ranges_m);
}

TEST(Carmen, DamagedGzipIsAnErrorNamingTheFile) {
  const TempDir dir;
  std::string text;
  for (int i = 0; i < 50; ++i) text += flaser_with(180, i, fmt::format("{}", 1.5 + i * 0.37), i);
  const std::string bytes = slurp(dir.write_gz("whole.log.gz", text));
  for (const std::size_t keep : {std::size_t{5}, bytes.size() / 2, bytes.size() - 4}) {
    const std::string error = error_of({dir.write("cut.log.gz", bytes.substr(0, keep))});
    EXPECT_TRUE(contains(error, "cut.log.gz")) << keep;
  }
  EXPECT_TRUE(contains(error_of({dir.write("cut.log.gz", bytes.substr(0, bytes.size() / 2))}), "truncated"));
  std::string flipped = bytes;
  flipped[flipped.size() - 6] = static_cast<char>(flipped[flipped.size() - 6] ^ 0x55);  // in the checksum
  EXPECT_TRUE(contains(error_of({dir.write("bad.log.gz", flipped)}), "bad.log.gz"));
}

TEST(Carmen, UnusableFilesAreNamed) {
  const TempDir dir;
  EXPECT_TRUE(contains(error_of({dir.at("missing.log")}), "missing.log: no such file"));
  EXPECT_TRUE(contains(error_of({dir.write("empty.log", "")}), "no usable record in"));
  EXPECT_TRUE(contains(error_of({dir.write("odom.log", "ODOM 0 0 0 0 0 0 1 h 1\n")}), "odom.log"));
  EXPECT_TRUE(
      contains(error_of({dir.write("junk.log", std::string("\x01\x00\xff\x07", 4))}), "junk.log: not a text log"));
  EXPECT_TRUE(contains(error_of({dir.write("cut.log", flaser(180, "3", 1).substr(0, 300))}), "cut.log:1: too short"));
  EXPECT_TRUE(contains(error_of({dir.write("a.log", flaser(180, "3", 1))}, "rosbag"), "'rosbag' is unknown"));
  std::filesystem::create_directory(dir.at("folder"));
  EXPECT_TRUE(contains(error_of({dir.at("folder")}, "carmen"), "is a folder"));
}

}  // namespace
}  // namespace evigrid::driver
