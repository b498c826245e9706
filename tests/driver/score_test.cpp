// SPDX-License-Identifier: Apache-2.0
// Scores counted by hand on a room corner of 4 × 3 cells.
#include "score/score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "evigrid/scenes/truth.hpp"
#include "score/rerender.hpp"

namespace evigrid::driver {
namespace {

using scenes::TruthCell;
using scenes::TruthGrid;

constexpr auto kS = TruthCell::solid, kW = TruthCell::surface, kF = TruthCell::free;

struct Masses {
  float e, o, u;
};
constexpr Masses kEmpty{0.8F, 0.1F, 0.1F}, kOccupied{0.1F, 0.8F, 0.1F}, kUnknown{0, 0, 1};

TruthGrid truth() {
  TruthGrid t;
  t.width = 4, t.height = 3, t.cell_m = 0.1;
  t.cells = {kS, kW, kF, kF,   // y = 0
             kS, kW, kF, kF,   // y = 1
             kS, kW, kW, kW};  // y = 2
  return t;
}

Layers layers(CellRect rect, const std::vector<Masses>& cells) {
  Layers l;
  l.rect = rect;
  l.cell_m = 0.1;
  l.planes.assign(4 * cells.size(), 0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    l.planes[i] = cells[i].e;
    l.planes[cells.size() + i] = cells[i].o;
    l.planes[2 * cells.size() + i] = cells[i].u;
  }
  return l;
}

Layers map() {
  return layers({0, 0, 4, 3}, {kUnknown, kOccupied, kEmpty, kEmpty,    //
                               kUnknown, kEmpty, kOccupied, kUnknown,  //
                               kUnknown, kOccupied, kEmpty, kUnknown});
}

TEST(Score, DecidesAsTheFinalMapOfLi2014) {
  EXPECT_EQ(decide(0.2F, 0.4F, 0.4F), Decision::occupied);
  EXPECT_EQ(decide(0.4F, 0.2F, 0.4F), Decision::empty);
  EXPECT_EQ(decide(0.1F, 0.4F, 0.5F), Decision::unknown);
  EXPECT_EQ(decide(0.4F, 0.4F, 0.2F), Decision::unknown);
  EXPECT_EQ(decide(0, 0, 1), Decision::unknown);
}

TEST(Score, CountsByHand) {
  const Score s = score(map(), truth());
  EXPECT_DOUBLE_EQ(s.strict.precision, 2.0 / 3);  // (1,0) and (1,2) of three called occupied
  EXPECT_DOUBLE_EQ(s.strict.recall, 2.0 / 5);     // all five walls border free space
  EXPECT_DOUBLE_EQ(s.strict.mistaken_rate, 3.0 / 7);
  EXPECT_DOUBLE_EQ(s.near.precision, 1);  // (2,1) is one cell beside a wall
  EXPECT_DOUBLE_EQ(s.near.recall, 1);
  EXPECT_DOUBLE_EQ(s.near.mistaken_rate, 0);
  EXPECT_DOUBLE_EQ(s.known_share, 3.0 / 4);
  EXPECT_DOUBLE_EQ(s.out_of_sight_share, 0);
  const auto at = [&](TruthCell t, Decision d) {
    return s.confusion[static_cast<std::size_t>(t)][static_cast<std::size_t>(d)];
  };
  EXPECT_EQ(at(kF, Decision::empty), 2u);
  EXPECT_EQ(at(kF, Decision::occupied), 1u);
  EXPECT_EQ(at(kF, Decision::unknown), 1u);
  EXPECT_EQ(at(kW, Decision::occupied), 2u);
  EXPECT_EQ(at(kW, Decision::empty), 2u);
  EXPECT_EQ(at(kW, Decision::unknown), 1u);
  EXPECT_EQ(at(kS, Decision::unknown), 3u);
}

TEST(Score, MeansOverFreeAndSurface) {
  // Free: 2 empty, 1 occupied, 1 unknown. Surface: 2 occupied, 2 empty, 1 unknown. Nine cells.
  const Score s = score(map(), truth());
  const double betp = 0.85, plp = 0.9 / 1.1;  // of a cell called occupied; of one called empty: 1 − the same
  const int right = 4, wrong = 3, unknown = 2;
  const double n = right + wrong + unknown;
  const double kTolerance = 1e-6;  // the masses are floats
  EXPECT_NEAR(s.log_loss_betp, -(right * std::log(betp) + wrong * std::log(1 - betp) + unknown * std::log(0.5)) / n,
              kTolerance);
  EXPECT_NEAR(s.log_loss_plp, -(right * std::log(plp) + wrong * std::log(1 - plp) + unknown * std::log(0.5)) / n,
              kTolerance);
  EXPECT_NEAR(s.brier_betp, (right * 0.15 * 0.15 + wrong * 0.85 * 0.85 + unknown * 0.25) / n, kTolerance);
  EXPECT_NEAR(s.brier_plp, (right * (1 - plp) * (1 - plp) + wrong * plp * plp + unknown * 0.25) / n, kTolerance);
  EXPECT_NEAR(s.map_score, (right * (1 + std::log2(betp)) + wrong * (1 + std::log2(1 - betp))) / n, kTolerance);
  EXPECT_NEAR(s.ignorance, (7 * 0.1 + 2 * 1.0) / 9, kTolerance);
  const double bits = -(betp * std::log2(betp) + (1 - betp) * std::log2(1 - betp));
  EXPECT_NEAR(s.entropy, (7 * bits + 2) / 9, kTolerance);
}

TEST(Score, MapSmallerOrLargerThanTheTruth) {
  const Score nothing = score(Layers{}, truth());
  EXPECT_TRUE(std::isnan(nothing.strict.precision));
  EXPECT_DOUBLE_EQ(nothing.strict.recall, 0);
  EXPECT_DOUBLE_EQ(nothing.map_score, 0);
  EXPECT_DOUBLE_EQ(nothing.ignorance, 1);
  // A cell called occupied far to the right of the truth: its margin is free there.
  const Score far = score(layers({10, 0, 1, 1}, {kOccupied}), truth());
  EXPECT_DOUBLE_EQ(far.strict.precision, 0);
  const Score behind = score(layers({0, 0, 2, 1}, {kOccupied, kOccupied}), truth());  // one solid, one surface
  EXPECT_DOUBLE_EQ(behind.strict.precision, 1);
  EXPECT_DOUBLE_EQ(behind.out_of_sight_share, 0.5);
  EXPECT_DOUBLE_EQ(far.strict.mistaken_rate, 1);
}

TEST(Score, SolidCalledEmptyIsAMistakeOnlyAwayFromFreeSpaceWhenNear) {
  const TruthGrid t = truth();
  const Score s = score(layers({0, 0, 1, 1}, {kEmpty}), t);
  EXPECT_DOUBLE_EQ(s.strict.mistaken_rate, 1);
  EXPECT_DOUBLE_EQ(s.near.mistaken_rate, 1);  // two cells from free space
}

TEST(Rerender, ComparesEachReadingWithTheNearestOccupiedCell) {
  std::vector<Masses> row(10, kEmpty);
  row[7] = kOccupied;  // its centre at x = 0.75 m, its near side at 0.7 m
  const Layers map = layers({0, 0, 10, 1}, row);
  Log log;
  Sensor sonar;
  sonar.model = Model::hughes1992;
  sonar.min_range_m = 0.1, sonar.max_range_m = 2, sonar.aperture_rad = 0.3;
  Sensor behind = sonar;
  behind.T_robot_sensor.yaw_rad = std::numbers::pi;
  Sensor laser;
  laser.model = Model::beam;
  laser.min_range_m = 0.1, laser.max_range_m = 2, laser.beams = 2;
  laser.first_beam_rad = 0, laser.beam_step_rad = std::numbers::pi / 2;
  for (const Sensor& s : {sonar, behind, laser}) log.sensors.push_back({"", s});
  log.ranges_m = {0.70F, 0.50F, 1.0F, INFINITY, 0.65F, 1.0F};
  log.readings = {{0, 0, 1}, {0, 1, 1}, {1, 2, 1}, {0, 3, 1}, {2, 4, 2}};
  log.scans = {{0, {0.05, 0.05, 0}, 0, 5}};
  const Rerendered r = rerender(map, log);
  EXPECT_EQ(r.readings, 5u);  // all but the one without echo
  EXPECT_EQ(r.silent, 2u);    // the sonar that looks back and the beam to the side
  // 0.70 of 0.70 and 0.50 of 0.70 by the cone; 0.65 of 0.65 by the beam, up to its step of a quarter cell.
  EXPECT_NEAR(r.median_m, 0, 0.026);
  EXPECT_NEAR(r.mean_m, 0.2 / 3, 0.01);
  EXPECT_TRUE(std::isnan(rerender(layers({0, 0, 1, 1}, {kEmpty}), log).mean_m));
}

}  // namespace
}  // namespace evigrid::driver
