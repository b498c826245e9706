// SPDX-License-Identifier: Apache-2.0
// evigrid::Map against the slow reference on laser fans: random, clipped, refused, borders through cell centres.
#include <numbers>
#include <random>

#include "tests/oracle/compare_maps.hpp"

namespace {

using namespace oracle;
using evigrid::Pose2;
using evigrid::Rule;
using evigrid::Sensor;

constexpr double kDegree = std::numbers::pi / 180;

Sensor laser(int beams, double first_deg, double step_deg) {
  Sensor s;
  s.model = evigrid::Model::beam;
  s.min_range_m = 0.1;
  s.max_range_m = 8;
  s.no_return_m = 50;
  s.beams = beams;
  s.first_beam_rad = first_deg * kDegree;
  s.beam_step_rad = step_deg * kDegree;
  return s;
}

/// Random ranges, a tenth of them clipped and a tenth refused.
std::vector<float> random_ranges(int beams, std::mt19937_64& engine) {
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<float> out;
  for (int i = 0; i < beams; ++i) {
    const float r = 0.2F + 9.0F * unit(engine);
    const float bad[] = {NAN, INFINITY, -INFINITY, -1, 0.05F, 50, 81.83F, 0};
    out.push_back(unit(engine) < 0.1F ? bad[engine() % 8] : r);
  }
  return out;
}

Difference drive(const Sensor& sensor, Rule rule, Pose2 pose, double cell_m, int scans) {
  Both both({.cell_m = cell_m, .rule = rule});
  const auto id = both.add(sensor);
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < scans; ++n) {
    both.integrate(pose, id, random_ranges(sensor.beams, engine));
    pose.x_m += 0.1 * unit(engine), pose.y_m += 0.07 * unit(engine), pose.yaw_rad += 0.4 * (unit(engine) - 0.5);
  }
  both.expect_equal_reports();
  return both.difference();
}

void expect_fan(const std::string& what, const Difference& d) {
  SCOPED_TRACE(what);
  expect_within_bounds(d);
  print(what, d);
}

TEST(ReferenceFan, HundredEightyBeamsInARowUnderEveryRule) {
  for (Rule rule : evigrid::map_rules()) {
    const Difference d = drive(laser(180, -90, 1), rule, {0.3, -0.2, 0.4}, 0.05, 20);
    EXPECT_GE(d.most_updates, 20U);
    expect_fan("fan 180 " + std::string(name(rule)), d);
  }
}

TEST(ReferenceFan, HalfDegreeFan) {
  expect_fan("fan 361", drive(laser(361, -90, 0.5), Rule::pcr5, {-4, 2.2, -2.8}, 0.05, 10));
}

TEST(ReferenceFan, ReliabilityMountAndClearedNoReturn) {
  Sensor s = laser(180, -90, 1);
  s.T_robot_sensor = {0.17, -0.04, 0.3};
  s.reliability = 0.8;
  s.reliability_if_empty = 0.6, s.reliability_if_occupied = 0.9;
  s.clear_no_return = true;
  expect_fan("fan mounted", drive(s, Rule::pcr5, {1, 1, 0.1}, 0.05, 10));
}

TEST(ReferenceFan, WholeTurnNarrowFanAndSingleBeam) {
  expect_fan("fan whole turn", drive(laser(360, 0, 1), Rule::pcr5, {0.025, 0.025, 0}, 0.05, 5));
  expect_fan("fan whole turn aligned", drive(laser(72, 2.5, 5), Rule::pcr5, {0.025, 0.025, 0}, 0.05, 1));
  expect_fan("fan narrow", drive(laser(7, -3, 0.9), Rule::pcr5, {2, 0, 3}, 0.05, 30));
  expect_fan("fan 270", drive(laser(1081, -135, 0.25), Rule::pcr2, {2, 0, 3}, 0.05, 4));
}

TEST(ReferenceFan, UtmSizedCoordinates) {
  expect_fan("fan UTM", drive(laser(180, -90, 1), Rule::pcr5, {500000.123, 5000000.456, 0.7}, 0.05, 10));
}

// Borders of beams exactly horizontal, vertical and diagonal from an apex on a centre, a corner or a side: whole rows
// of centres lie on them, and ranges end exactly on centres.
TEST(ReferenceFan, BordersThroughCellCentres) {
  const double cell = 0.125;
  Difference all;
  for (double first_deg : {-89.5, -90.0, -87.5})
    for (double step_deg : {1.0, 5.0, 15.0, 30.0})
      for (int heading : {0, 45, 90, 135, 180, 225, 270, 315})
        for (double ox : {0.0, 0.5})
          for (double oy : {0.0, 0.5}) {
            const int beams = static_cast<int>(180 / step_deg);
            Sensor s = laser(beams, first_deg, step_deg);
            s.first_beam_rad = (first_deg < -89.6 ? -90 + step_deg / 2 : first_deg) * kDegree;
            s.beam.empty_margin_m = 2 * cell;  // zones and the clipped range end on centres
            s.beam.occupied_half_width_m = cell;
            const Pose2 pose{(5 + ox) * cell, (-2 + oy) * cell, heading * kDegree};
            std::vector<float> ranges(beams);
            for (int i = 0; i < beams; ++i) ranges[i] = static_cast<float>((i % 5 == 4 ? 70 : 8 + i % 40) * cell);
            SCOPED_TRACE(testing::Message()
                         << first_deg << ' ' << step_deg << ' ' << heading << ' ' << ox << ' ' << oy);
            all.merge(once({.cell_m = cell}, s, pose, ranges));
          }
  expect_fan("fan aligned", all);
}

TEST(ReferenceFan, WrongBeamCountIsRefusedOnce) {
  Both both(evigrid::MapParams{});
  const auto id = both.add(laser(180, -90, 1));
  const std::vector<float> ranges(179, 2.0F);
  both.integrate({}, id, ranges);
  both.expect_equal_reports();
  EXPECT_EQ(both.report().refused_total(), 1U);
  EXPECT_EQ(both.engine().bounds(), evigrid::CellRect{});
}

}  // namespace
