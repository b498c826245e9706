// SPDX-License-Identifier: Apache-2.0
// evigrid::Map against the slow reference on recordings: a laser log (CARMEN text) and a ring of eight sonars.
#include <zlib.h>

#include <fstream>
#include <numbers>
#include <sstream>

#include "tests/oracle/compare_maps.hpp"

namespace {

using namespace oracle;
using evigrid::Pose2;

constexpr double kDegree = std::numbers::pi / 180;

struct LaserScan {
  std::vector<float> ranges_m;
  Pose2 pose;
};

/// The FLASER lines of a gzipped CARMEN log: FLASER n r1 .. rn x y theta ...
std::vector<LaserScan> read_flaser(const std::string& path) {
  std::vector<LaserScan> out;
  gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) return out;
  std::vector<char> line(1 << 16);
  while (gzgets(file, line.data(), static_cast<int>(line.size())) != nullptr) {
    std::istringstream words(line.data());
    std::string keyword;
    std::size_t n = 0;
    if (!(words >> keyword) || keyword != "FLASER" || !(words >> n)) continue;
    LaserScan scan;
    scan.ranges_m.resize(n);
    for (float& r : scan.ranges_m) words >> r;
    if (words >> scan.pose.x_m >> scan.pose.y_m >> scan.pose.yaw_rad) out.push_back(std::move(scan));
  }
  gzclose(file);
  return out;
}

TEST(ReferenceLog, IntelLaserLogUnderPcr5) {
  const std::string path = std::string(EVIGRID_DATA_DIR) + "/laser/ple-radish-corrected/intel-corrected.log.gz";
  const std::vector<LaserScan> scans = read_flaser(path);
  if (scans.empty()) GTEST_SKIP() << "missing recording: " << path;
  ASSERT_EQ(scans.size(), 910U);
  float largest = 0;
  for (const LaserScan& s : scans) largest = std::max(largest, *std::max_element(s.ranges_m.begin(), s.ranges_m.end()));
  evigrid::Sensor laser;
  laser.model = evigrid::Model::beam;
  laser.max_range_m = 10;
  laser.no_return_m = largest;
  laser.beams = 180;
  laser.first_beam_rad = -90 * kDegree;
  laser.beam_step_rad = 1 * kDegree;
  Both both({.cell_m = 0.05, .rule = evigrid::Rule::pcr5});
  const auto id = both.add(laser);
  for (const LaserScan& s : scans) both.integrate(s.pose, id, s.ranges_m);
  both.expect_equal_reports();
  const Difference d = both.difference();
  EXPECT_GT(d.cells, 100'000U);
  EXPECT_GE(d.most_updates, 50U);
  expect_within_bounds(d);
  print("intel log pcr5", d);
}

TEST(ReferenceLog, EightSonarRingLog) {
  const std::string folder = std::string(EVIGRID_DATA_DIR) + "/sonar/udacity-8ring/";
  std::ifstream poses(folder + "poses.txt"), echoes(folder + "measurement.txt");
  if (!poses) GTEST_SKIP() << "missing recording: " << folder << "poses.txt";
  if (!echoes) GTEST_SKIP() << "missing recording: " << folder << "measurement.txt";
  std::vector<Pose2> way;
  std::vector<std::array<float, 8>> ranges_m;
  double stamp_ms = 0, x_mm = 0, y_mm = 0, theta_decidegree = 0;
  while (poses >> stamp_ms >> x_mm >> y_mm >> theta_decidegree)
    way.push_back({x_mm / 1000, y_mm / 1000, theta_decidegree / 10 * kDegree});
  for (std::array<float, 8> r{}; echoes >> stamp_ms;) {
    for (float& z : r) echoes >> z, z = z >= 5110 ? INFINITY : z / 1000;
    ranges_m.push_back(r);
  }
  ASSERT_EQ(way.size(), ranges_m.size());
  ASSERT_GT(way.size(), 200U);
  for (evigrid::Rule rule : evigrid::map_rules()) {
    SCOPED_TRACE(std::string(name(rule)));
    Both both({.cell_m = 0.1, .rule = rule});
    std::vector<evigrid::SensorId> ids;
    for (double bearing_deg : {-90.0, -37.5, -22.5, -7.5, 7.5, 22.5, 37.5, 90.0}) {
      evigrid::Sensor s;
      s.model = evigrid::Model::li2014;
      s.T_robot_sensor.yaw_rad = bearing_deg * kDegree;
      s.aperture_rad = 20 * kDegree;
      s.min_range_m = 0.17;
      s.max_range_m = 5;
      s.reliability = 0.9;
      ids.push_back(both.add(s));
    }
    for (std::size_t n = 0; n < way.size(); ++n) {
      std::vector<evigrid::Reading> readings;
      for (std::size_t i = 0; i < ids.size(); ++i) readings.push_back({ids[i], {&ranges_m[n][i], 1}});
      both.integrate(evigrid::Scan{static_cast<std::int64_t>(n), way[n], readings});
    }
    both.expect_equal_reports();
    const Difference d = both.difference();
    EXPECT_GT(d.cells, 1'000U);
    expect_within_bounds(d);
    print("sonar ring log " + std::string(name(rule)), d);
  }
}

}  // namespace
