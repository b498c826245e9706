// SPDX-License-Identifier: Apache-2.0
// Units, signs and poses of each format, by small logs whose answer is known by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "error.hpp"
#include "log/dead_reckoning.hpp"
#include "log/readers.hpp"
#include "log/select.hpp"
#include "log/summary.hpp"
#include "log_samples.hpp"

namespace evigrid::driver {
namespace {

constexpr double kDeg = std::numbers::pi / 180;

Log read_text(const std::string& text) {
  const std::string_view bytes[] = {text};
  return read_log_bytes("auto", bytes);
}

std::string error_of(const std::string& text, const std::string& format = "auto") {
  try {
    const std::string_view bytes[] = {text};
    (void)read_log_bytes(format, bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(no error)";
}

TEST(Wean, CentimetresMountAndNoReturn) {
  std::string row = wean_scan("250", 3.25, "100 -200 0.5");
  row = with_field(row, ' ', 7, "8183");        // beam 0
  row = with_field(row, ' ', 7 + 179, "8191");  // beam 179
  const Log log = read_text("O 1 2 3 4\nO 1 2 3\n" + row + "\n");
  ASSERT_EQ(log.scans.size(), 1u);
  const Sensor& s = log.sensors.at(0).sensor;
  EXPECT_EQ(s.beams, 180);
  EXPECT_NEAR(s.first_beam_rad + 179 * s.beam_step_rad, -s.first_beam_rad, 1e-12);  // symmetric about ahead
  EXPECT_DOUBLE_EQ(s.T_robot_sensor.x_m, 0.25);
  EXPECT_DOUBLE_EQ(log.scans[0].T_map_robot.x_m, 1);
  EXPECT_DOUBLE_EQ(log.scans[0].T_map_robot.y_m, -2);
  EXPECT_DOUBLE_EQ(log.scans[0].T_map_robot.yaw_rad, 0.5);
  EXPECT_EQ(log.scans[0].stamp_ns, 3'250'000'000);
  EXPECT_FLOAT_EQ(log.ranges_m[1], 2.5F);
  EXPECT_GE(static_cast<double>(log.ranges_m[0]), s.no_return_m);
  EXPECT_GE(static_cast<double>(log.ranges_m[179]), s.no_return_m);
  EXPECT_EQ(log.skipped.at("O"), 1u);
  EXPECT_EQ(log.malformed.at("too short"), 1u);
}

TEST(Wean, ALaserPoseOffTheMountIsCounted) {
  const Log log = read_text(wean_scan("250", 1) + "\n" + wean_scan("250", 2, "100 200 0", "100 225 0") + "\n" +
                            wean_scan("250", 3, "100 200 1.5707963268", "100 225 1.5707963268") + "\n");
  EXPECT_EQ(log.scans.size(), 3u);
  EXPECT_EQ(log.facts.at("laser_poses_off_mount"), 1);
  EXPECT_NEAR(log.facts.at("laser_pose_deviation_max_m"), 0.25 * std::sqrt(2), 1e-9);
}

TEST(DeadReckoning, ArcsOfExactCircles) {
  const Pose2 straight = driven({1, 2, 90 * kDeg}, 0.5, 0.5, 0.2);
  EXPECT_NEAR(straight.x_m, 1, 1e-12);
  EXPECT_NEAR(straight.y_m, 2.5, 1e-12);
  const Pose2 spin = driven({0, 0, 0}, -0.1 * std::numbers::pi / 2, 0.1 * std::numbers::pi / 2, 0.2);
  EXPECT_NEAR(spin.yaw_rad, 90 * kDeg, 1e-12);
  EXPECT_NEAR(spin.x_m, 0, 1e-12);
  // A quarter of a circle of radius 1 to the left ends at (1, 1); wheels at radius 0.9 and 1.1.
  const double quarter = std::numbers::pi / 2;
  const Pose2 arc = driven({0, 0, 0}, 0.9 * quarter, 1.1 * quarter, 0.2);
  EXPECT_NEAR(arc.x_m, 1, 1e-12);
  EXPECT_NEAR(arc.y_m, 1, 1e-12);
  EXPECT_NEAR(arc.yaw_rad, quarter, 1e-12);
}

TEST(DeadReckoning, ReferenceFitFindsTheFrameAndTheRest) {
  std::vector<TimedPose> way;
  std::vector<TimedPosition> reference;
  for (int i = 0; i < 50; ++i) {
    const double x = 0.1 * i, y = 0.002 * i * i, turn = 2.5;
    way.push_back({i, {x, y, 0}});
    const double off = i % 2 == 0 ? 0.01 : -0.01;  // across the line: cannot be turned or shifted away
    reference.push_back(
        {i, std::cos(turn) * x - std::sin(turn) * (y + off) + 7, std::sin(turn) * x + std::cos(turn) * (y + off) - 3});
  }
  const ReferenceFit fit = fit_reference(way, reference);
  EXPECT_EQ(fit.points, 50u);
  EXPECT_NEAR(fit.yaw_rad, 2.5, 1e-3);
  EXPECT_NEAR(fit.rms_m, 0.01, 2e-4);
  EXPECT_GE(fit.max_m, fit.rms_m);
}

TEST(Lego, MillimetresTicksAndCodes) {
  // 1000 ticks of both wheels are 349 mm; the second scan lies half way in time.
  std::string scan = lego_scan(1000, 500);
  scan = with_field(scan, ' ', 3, "15");
  const Log log = read_text(lego_motors(0, 500, 700) + lego_motors(1000, 1500, 1700) + scan + "\nL C 1 2 3\n" +
                            "P 0 1000 1000\nP 1000 1000 1349\n");
  ASSERT_EQ(log.scans.size(), 1u);
  EXPECT_EQ(log.poses, Poses::dead_reckoned);
  EXPECT_NEAR(log.scans[0].T_map_robot.x_m, 0.1745, 1e-9);
  EXPECT_NEAR(log.scans[0].T_map_robot.y_m, 0, 1e-12);
  EXPECT_TRUE(std::isinf(log.ranges_m[0]));
  EXPECT_FLOAT_EQ(log.ranges_m[1], 1.001F);
  const Sensor& s = log.sensors.at(0).sensor;
  EXPECT_NEAR(s.first_beam_rad + 330 * s.beam_step_rad, 0, 1e-12);
  EXPECT_DOUBLE_EQ(s.T_robot_sensor.x_m, 0.03);
  EXPECT_EQ(log.skipped.at("L"), 1u);
  EXPECT_NEAR(log.facts.at("reference_yaw_deg"), 90, 1e-6);
  EXPECT_NEAR(log.facts.at("reference_deviation_max_m"), 0, 1e-9);
}

TEST(Lego, TheFasterRightWheelTurnsLeft) {
  const Log log = read_text(lego_motors(0, 0, 0) + lego_motors(1000, 0, 100) + lego_scan(1000, 1000) + "\n");
  EXPECT_NEAR(log.scans.at(0).T_map_robot.yaw_rad, 100 * 0.349e-3 / 0.173, 1e-12);
}

TEST(Lego, BrokenCountersAndTimesAreCounted) {
  const Log log = read_text(lego_motors(1000, 0, 0) + lego_motors(500, 1, 1) + lego_motors(1500, 900000, 0) +
                            lego_motors(2000, 10, 10) + lego_scan(1000, 1500) + "\n" + lego_scan(1000, 9000) + "\n");
  EXPECT_EQ(log.scans.size(), 1u);
  EXPECT_EQ(log.malformed.at("time backwards"), 1u);
  EXPECT_EQ(log.malformed.at("absurd step"), 1u);
  EXPECT_EQ(log.malformed.at("no pose"), 1u);
  EXPECT_NEAR(log.scans[0].T_map_robot.x_m, 5 * 0.349e-3, 1e-12);
}

TEST(Lego, TimesWhoseDifferenceNeedsMoreThan64BitsAreNone) {
  const auto motors = [](const std::string& t) { return with_field(lego_motors(0, 0, 0), ' ', 1, t); };
  const Log log = read_text(motors("-4.4e12") + motors("4.4e12") + motors("8.9e12") + lego_scan(1000, 0) + "\n");
  EXPECT_EQ(log.malformed.at("bad number"), 1u);
  EXPECT_EQ(log.scans.size(), 1u);
  EXPECT_EQ(summarise(log)["time"]["span_s"], 0.0);
}

TEST(Lego, AFolderOrAnyOfItsFilesIsTheLog) {
  const TempDir dir;
  const std::string scan = dir.write("robot4_scan.txt", lego_scan(1000, 0) + "\n");
  const std::string motors = dir.write("robot4_motors.txt", lego_motors(0, 0, 0));
  for (const std::vector<std::string>& named :
       {std::vector{dir.at("")}, std::vector{scan}, std::vector{motors}, std::vector{motors, scan}}) {
    const Log log = read_log(named, "auto");
    EXPECT_EQ(log.format, "lego");
    EXPECT_EQ(log.scans.size(), 1u) << named.front();
  }
  dir.write("robot5_scan.txt", "");
  EXPECT_THROW((void)read_log({dir.at("")}, "auto"), InputError);
}

TEST(BigWheelBot, ReadingsComeBeforeTheIncrementAndYawIsClockwise) {
  const Log log = read_text("200,200,90,100,520,0,60,1,2\n0,0,0,523,30,25,10,1,2\n");
  ASSERT_EQ(log.scans.size(), 2u);
  EXPECT_DOUBLE_EQ(log.scans[0].T_map_robot.x_m, 0);
  EXPECT_NEAR(log.scans[0].T_map_robot.yaw_rad, -90 * kDeg, 1e-12);
  EXPECT_NEAR(log.scans[1].T_map_robot.x_m, 0, 1e-12);
  EXPECT_NEAR(log.scans[1].T_map_robot.y_m, -1, 1e-12);  // 200 ticks of 5 mm
  const auto bearing_deg = [&](std::size_t i) { return log.sensors.at(i).sensor.T_robot_sensor.yaw_rad / kDeg; };
  EXPECT_NEAR(bearing_deg(0), 0, 1e-12);
  EXPECT_NEAR(bearing_deg(1), 180, 1e-12);
  EXPECT_NEAR(bearing_deg(2), 45, 1e-12);  // the left one is on the left
  EXPECT_NEAR(bearing_deg(3), -45, 1e-12);
  const auto no_return = [&](std::size_t range, std::size_t sensor) {
    return static_cast<double>(log.ranges_m[range]) >= log.sensors[sensor].sensor.no_return_m;
  };
  EXPECT_FLOAT_EQ(log.ranges_m[0], 1);
  EXPECT_TRUE(no_return(1, 1) && no_return(3, 3) && no_return(4, 0));
  EXPECT_TRUE(std::isnan(log.ranges_m[2]));
  EXPECT_FLOAT_EQ(log.ranges_m[6], 0.25F);
  EXPECT_EQ(log.facts.at("ir_dropouts"), 1);
  EXPECT_EQ(log.scans[1].stamp_ns, 100'000'000);
}

TEST(BigWheelBot, ABrokenEncoderDoesNotMoveTheRobot) {
  const Log log = read_text("0,0,0,9,9,9,9,1,2\n900000,0,0,9,9,9,9,1,2\nnan,0,0,9,9,9,9,1,2\n0,0,0,9,9,9,9,1,2\n");
  EXPECT_EQ(log.scans.size(), 2u);
  EXPECT_EQ(log.malformed.at("absurd step"), 1u);
  EXPECT_EQ(log.malformed.at("bad number"), 1u);
  EXPECT_DOUBLE_EQ(log.scans[1].T_map_robot.x_m, 0);
}

TEST(Roomba12, PosesBearingsAndEmptyFields) {
  const Log log = read_text("x,y,heading_angle_degrees," + numbered("sensor_", 0, 12) +
                            "\n4.0,3.0,90.0,1.5,,3.5,1,1,1,1,1,1,1,1,2.5\n");
  ASSERT_EQ(log.scans.size(), 1u);
  EXPECT_DOUBLE_EQ(log.scans[0].T_map_robot.y_m, 3);
  EXPECT_NEAR(log.scans[0].T_map_robot.yaw_rad, 90 * kDeg, 1e-12);
  EXPECT_NEAR(log.sensors.at(4).sensor.T_robot_sensor.yaw_rad, 120 * kDeg, 1e-12);
  EXPECT_FLOAT_EQ(log.ranges_m[0], 1.5F);
  EXPECT_TRUE(std::isinf(log.ranges_m[1]));
  EXPECT_GE(static_cast<double>(log.ranges_m[2]), log.sensors[2].sensor.no_return_m);
  EXPECT_FLOAT_EQ(log.ranges_m[11], 2.5F);
}

TEST(Roomba12, MissingColumnsAreNamed) {
  EXPECT_TRUE(contains(error_of("x,y,heading_angle_degrees,sensor_0\n1,2,3,4\n"), "(bytes 1):1:sensor_1"));
}

TEST(Roomba12, ColumnsInAnotherOrderAreNotReadAsIfTheyWereInOrder) {
  EXPECT_TRUE(contains(
      error_of("y,x,heading_angle_degrees," + numbered("sensor_", 0, 12) + "\n4,3,90," + repeated("1.5", 12) + "\n"),
      "(bytes 1):1:x: is not column 1"));
}

TEST(Uci24, ClockwiseWithoutPoses) {
  std::string row = repeated("1.5", 24) + ",Sharp-Right-Turn";
  row = with_field(row, ',', 3, "5.000");
  const Log log = read_text(row + "\n");  // without a head line, as first published
  EXPECT_EQ(log.format, "uci24");
  EXPECT_EQ(log.poses, Poses::none);
  ASSERT_EQ(log.sensors.size(), 24u);
  EXPECT_NEAR(log.sensors[6].sensor.T_robot_sensor.yaw_rad, -90 * kDeg, 1e-12);  // S7: to the right
  EXPECT_GE(static_cast<double>(log.ranges_m[3]), log.sensors[3].sensor.no_return_m);
  EXPECT_FLOAT_EQ(log.ranges_m[4], 1.5F);
}

TEST(Uci24, SimplifiedVariantsAreRefusedWithTheReason) {
  EXPECT_TRUE(contains(error_of("1.6,0.4,0.5,1.7,Move-Forward\n"), "4 columns: the simplified variant"));
  EXPECT_TRUE(contains(error_of("1.6,0.4,Move-Forward\n"), "2 columns: the simplified variant"));
  EXPECT_TRUE(contains(error_of("SD_front,SD_left,SD_right,SD_back,Class\n1,1,1,1,a-b\n"), "simplified"));
}

TEST(Enmt482, TruthBesideRanges) {
  const Log log = read_text(",time,range,velocity_command,sonar2,sonar1\n0,1.5,2.0,0.1,5.0,1.9\n");
  ASSERT_EQ(log.scans.size(), 1u);
  EXPECT_EQ(log.poses, Poses::one_dimension);
  EXPECT_EQ(log.scans[0].stamp_ns, 1'500'000'000);
  EXPECT_FLOAT_EQ(log.ranges_m[0], 1.9F);  // columns are found by name
  EXPECT_FLOAT_EQ(log.truth_m[0], 2.0F);
  EXPECT_FLOAT_EQ(log.truth_m[1], 2.0F);
  EXPECT_GE(static_cast<double>(log.ranges_m[1]), log.sensors[1].sensor.no_return_m);
  EXPECT_TRUE(contains(error_of(",time,range,velocity_command,sonar1\n0,1,1,1,1\n"), ":1:sonar2"));
}

TEST(Select, ScansByNumberAndRange) {
  std::string text;
  for (int i = 0; i < 5; ++i) text += wean_scan("300", i) + "\n";
  const auto stamps = [&](const std::string& which) {
    Log log = read_text(text);
    keep_scans(log, which);
    std::vector<int> out;
    for (const LogScan& scan : log.scans) out.push_back(static_cast<int>(scan.stamp_ns / 1'000'000'000));
    return out;
  };
  EXPECT_EQ(stamps("2"), (std::vector{2}));
  EXPECT_EQ(stamps("1:3"), (std::vector{1, 2}));
  EXPECT_EQ(stamps(":2"), (std::vector{0, 1}));
  EXPECT_EQ(stamps("3:"), (std::vector{3, 4}));
  for (const char* bad : {"5", "", "2:2", "3:1", "0:6", "-1", "x", "1:2:3", "99999999999999999999999"}) {
    Log log = read_text(text);
    EXPECT_THROW(keep_scans(log, bad), InputError) << bad;
  }
}

TEST(Select, SensorsByKindAndName) {
  const std::string text = "0,0,0,100,90,30,20,1,2\n0,0,0,101,91,31,21,1,2\n";
  Log log = read_text(text);
  keep_sensors(log, {"ir", "rear"});
  ASSERT_EQ(log.readings.size(), 6u);
  EXPECT_EQ(log.scans[1].first, 3u);
  EXPECT_EQ(log.scans[1].count, 3u);
  EXPECT_FLOAT_EQ(log.ranges_m[log.readings[3].first], 0.91F);
  EXPECT_THROW(keep_sensors(log, {"radar"}), InputError);
}

TEST(Summary, SharesAndQuantilesByHand) {
  const auto s = summarise(read_text("0,0,0,100,520,30,0,1,2\n0,0,0,200,530,60,0,1,2\n0,0,0,300,1,20,5,1,2\n"));
  const auto& front = s["sensors"][0];
  EXPECT_EQ(front["ranges"], 3);
  EXPECT_EQ(front["in_range"], 3);
  EXPECT_EQ(front["range_quantiles_m"][3], 2.0);
  EXPECT_EQ(s["sensors"][1]["no_return"], 2);
  EXPECT_EQ(s["sensors"][1]["too_near"], 1);
  EXPECT_EQ(s["sensors"][3]["not_a_number"], 2);
  EXPECT_EQ(s["stamps"], "none: scan number times a nominal 0.1 s");
  EXPECT_TRUE(contains(summary_text(s), "sonar front"));
}

}  // namespace
}  // namespace evigrid::driver
