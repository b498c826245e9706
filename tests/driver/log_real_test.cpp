// SPDX-License-Identifier: Apache-2.0
// Recorded logs of the lesser formats, where they are at hand: counts that a second reader (Python, awk) gave, and
// whether scans overlay better as read than mirrored: a wrong sign doubles every wall.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "log/readers.hpp"
#include "program.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;

std::string data(const std::string& name) { return std::string(EVIGRID_DATA_DIR) + "/" + name; }

#define NEED(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "missing recorded data: " << (path)

Json json_of(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--json", "-"});
  const Ran ran = evigrid(arguments);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return Json::parse(ran.out, nullptr, false);
}

/// Cells of 4 cm that end points of beams fall into, counted anew every `window` scans; bearings times `sign`.
std::size_t touched_cells(const Log& log, std::size_t window, double sign) {
  std::set<std::tuple<std::size_t, long, long>> cells;
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    const LogScan& scan = log.scans[i];
    for (std::size_t k = scan.first; k < scan.first + scan.count; ++k) {
      const LogReading& r = log.readings[k];
      const Sensor& s = log.sensors[r.sensor].sensor;
      for (std::size_t b = 0; b < r.count; ++b) {
        const double range_m = static_cast<double>(log.ranges_m[r.first + b]);
        if (!(range_m < std::min({s.no_return_m, s.max_range_m, 6.0}))) continue;
        const Pose2& p = scan.T_map_robot;
        const double x = p.x_m + s.T_robot_sensor.x_m * std::cos(p.yaw_rad);
        const double y = p.y_m + s.T_robot_sensor.x_m * std::sin(p.yaw_rad);
        const double bearing = s.T_robot_sensor.yaw_rad + s.first_beam_rad + static_cast<double>(b) * s.beam_step_rad;
        const double a = p.yaw_rad + sign * bearing;
        cells.emplace(i / window, std::lround((x + range_m * std::cos(a)) / 0.04),
                      std::lround((y + range_m * std::sin(a)) / 0.04));
      }
    }
  }
  return cells.size();
}

void expect_overlay(const Log& log, std::size_t window, double at_least) {
  const auto as_read = static_cast<double>(touched_cells(log, window, 1));
  const auto mirrored = static_cast<double>(touched_cells(log, window, -1));
  EXPECT_GT(mirrored, at_least * as_read);
}

TEST(RealLogs, Wean) {
  for (const auto& [name, scans, odometry, no_return] : {std::tuple{"1", 713, 1505, 693}, {"3", 1241, 1735, 3669}}) {
    const std::string path = data(std::string("laser/cmu-wean/robotdata") + name + ".log");
    NEED(path);
    const TempDir dir;
    const Json r = json_of({"map", path, "-o", dir.at("out")});
    EXPECT_EQ(r["format"], "wean");
    EXPECT_EQ(r["scans"], scans);
    EXPECT_EQ(r["readings_used"], scans * 180 - no_return);
    EXPECT_EQ(r["readings_refused"], Json({{"no_return", no_return}}));
    EXPECT_EQ(r["records_skipped"], Json({{"O", odometry}}));
    EXPECT_EQ(r["records_malformed"], Json::object());
    EXPECT_EQ(r["log_facts"]["laser_poses_off_mount"], 0);
    EXPECT_LT(r["log_facts"]["laser_pose_deviation_max_m"], 1e-6);
    expect_overlay(read_log({path}, "auto"), 60, 1.3);
  }
}

TEST(RealLogs, Lego) {
  const std::string path = data("laser/brenner-lego");
  NEED(path);
  const Json r = json_of({"log", path});
  EXPECT_EQ(r["format"], "lego");
  EXPECT_EQ(r["scans"], 278);
  EXPECT_EQ(r["sensors"][0]["no_return"], 41);
  EXPECT_EQ(r["records_malformed"], Json::object());
  EXPECT_LT(r["log_facts"]["reference_deviation_rms_m"], 0.08);  // the wheels drift; a wrong turn would give 0.5 m
  expect_overlay(read_log({path}, "auto"), 300, 1.3);
}

TEST(RealLogs, BigWheelBot) {
  for (const auto& [name, lines] :
       {std::pair{"10_04_20", 1666}, {"15_03_20", 864}, {"27_03_20", 652}, {"27_03_20_2", 572}, {"small", 424}}) {
    const std::string path = data(std::string("sonar/bigwheelbot/Garden_") + name + ".txt");
    NEED(path);
    const TempDir dir;
    const Json r = json_of({"map", path, "-o", dir.at("out"), "--sensors", "sonar"});
    EXPECT_EQ(r["format"], "bigwheelbot");
    EXPECT_EQ(r["scans"], lines);
    EXPECT_EQ(r["records_malformed"], Json::object());
    // Yaw is clockwise: our yaw rises where the right wheel goes farther, summed over the log.
    const Log log = read_log({path}, "auto");
    double together = 0;
    std::istringstream text(slurp(path));
    std::vector<std::vector<double>> rows;
    for (std::string line; std::getline(text, line);) {
      rows.emplace_back();
      std::istringstream fields(line);
      for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(std::stod(field));
    }
    ASSERT_EQ(rows.size(), log.scans.size());
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double turn =
          std::remainder(log.scans[i].T_map_robot.yaw_rad - log.scans[i - 1].T_map_robot.yaw_rad, 2 * 3.14159265358979);
      together += turn * (rows[i][1] - rows[i][0]);
    }
    EXPECT_GT(together, 0);
  }
}

TEST(RealLogs, Roomba12) {
  const std::string path = data("sonar/roomba12-simulated/sonar_dataset.csv");
  NEED(path);
  const Log log = read_log({path}, "auto");
  EXPECT_EQ(log.scans.size(), 300u);
  std::size_t empty = 0;
  for (const float r : log.ranges_m) empty += std::isinf(r) ? 1 : 0;
  EXPECT_EQ(empty, 177u);
  expect_overlay(log, 300, 1.2);
}

TEST(RealLogs, Uci24) {
  const std::string path = data("sonar/uci-scitos24/sensor_readings_24.data");
  NEED(path);
  const TempDir dir;
  const Ran refused = evigrid({"map", path, "-o", dir.at("out")});
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(contains(refused.err, "has no poses: choose what to map with --scans"));
  const Json r = json_of({"map", path, "-o", dir.at("out"), "--scans", "120"});
  EXPECT_EQ(r["scans"], 1);
  EXPECT_EQ(r["scans_chosen"], "120");
  EXPECT_EQ(r["poses"], "none: the robot stands at the origin");
  EXPECT_EQ(r["readings_used"], 20);
  EXPECT_EQ(r["readings_refused"], Json({{"no_return", 4}}));
  EXPECT_EQ(json_of({"log", path})["scans"], 5456);
}

TEST(RealLogs, Enmt482) {
  for (const auto& [name, rows, off1, off2] :
       {std::tuple{"calibration", 3023, 0.17135, 0.06054}, {"training1", 4819, 0.14899, 0.11724}}) {
    const std::string path = data(std::string("sonar/enmt482-turtlebot/") + name + ".csv");
    NEED(path);
    const Json r = json_of({"calibrate", path});
    EXPECT_EQ(r["sensors"][0]["all"]["samples"], rows);
    EXPECT_NEAR(r["sensors"][0]["all"]["off_share"], off1, 1e-5);
    EXPECT_NEAR(r["sensors"][1]["all"]["off_share"], off2, 1e-5);
    const TempDir dir;
    const Ran refused = evigrid({"map", path, "-o", dir.at("out")});
    EXPECT_EQ(refused.code, 2);
    EXPECT_TRUE(contains(refused.err, "evigrid calibrate"));
  }
}

}  // namespace
}  // namespace evigrid::driver
