// SPDX-License-Identifier: Apache-2.0
// Maps whose state is not (e, o, u): sums in any order, taking back, repeated readings, Bayes against Dempster,
// history.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "equivalence/random_scans.hpp"

namespace evigrid {
namespace {

using testing::Drive;

Map mapped(const Drive& d, const MapParams& params, const std::vector<Scan>& scans) {
  Map map(params, make_serial_executor());
  for (const Sensor& s : d.sensors) map.add(s);
  map.integrate(scans);
  return map;
}
/// Everything a map keeps but the last stamp: its cells as a file holds them.
std::string cells_of(const Map& map) {
  std::ostringstream out;
  save(map, out);
  const std::string bytes = out.str();
  return bytes.substr(bytes.find("\x28\xB5\x2F\xFD"));  // from the first zstd frame on
}

class Sums : public ::testing::TestWithParam<Rule> {};

TEST_P(Sums, AnyOrderOfScansGivesTheSameBits) {
  const auto d = testing::drive(Model::li2014, 30, 31);
  const MapParams params{.rule = GetParam(), .keep_conflict = false};
  const Map in_order = mapped(*d, params, d->scans);
  std::mt19937 rng(5);
  for (int round = 0; round < 3; ++round) {
    std::vector<Scan> shuffled = d->scans;
    std::shuffle(shuffled.begin(), shuffled.end(), rng);
    const Map other = mapped(*d, params, shuffled);
    EXPECT_EQ(other.hash(), in_order.hash());
    EXPECT_TRUE(cells_of(other) == cells_of(in_order));
  }
}
INSTANTIATE_TEST_SUITE_P(Rules, Sums, ::testing::Values(Rule::dempster_log, Rule::murphy, Rule::cautious),
                         [](const auto& p) { return std::string(name(p.param)); });

TEST(Order, CountsForMasses) {
  const auto d = testing::drive(Model::li2014, 30, 31);
  std::vector<Scan> backwards(d->scans.rbegin(), d->scans.rend());
  for (const Rule rule : {Rule::dempster, Rule::pcr5, Rule::yager})
    EXPECT_NE(mapped(*d, {.rule = rule}, d->scans).hash(), mapped(*d, {.rule = rule}, backwards).hash()) << name(rule);
}

TEST(Undo, GivesTheBitsOfAMapWithoutTheScans) {
  for (const Model model : {Model::li2014, Model::hughes1992}) {
    const auto d = testing::drive(model, 24, 32);
    for (const Rule rule : {Rule::dempster_log, Rule::murphy}) {
      const MapParams params{.rule = rule, .keep_conflict = false};
      Map map = mapped(*d, params, d->scans);
      const Map all = mapped(*d, params, d->scans);
      std::vector<Scan> taken, kept;
      for (std::size_t i = 0; i < d->scans.size(); ++i) (i % 3 == 1 ? taken : kept).push_back(d->scans[i]);
      const Report back = map.undo(taken);
      EXPECT_EQ(back.cells_updated, mapped(*d, params, {}).integrate(taken).cells_updated);
      EXPECT_EQ(back.stamps_backwards, 0U);
      EXPECT_EQ(map.hash(), mapped(*d, params, kept).hash());
      EXPECT_NE(map.hash(), all.hash());
      map.integrate(taken);
      EXPECT_TRUE(cells_of(map) == cells_of(all));
      map.undo(d->scans);
      EXPECT_EQ(map.hash(), Map(params, make_serial_executor()).hash());  // nothing was ever said
      EXPECT_EQ(map.bounds(), CellRect{});
      map.undo(d->scans.front());  // more than ever came: no masses, but numbers still
      const CellRect r{-40, -40, 160, 160};
      std::vector<float> unknown(static_cast<std::size_t>(r.width * r.height));
      map.render(Layer::unknown, r, unknown, r.width);
      for (const float u : unknown) ASSERT_TRUE(u >= 0 && u <= 1.001F);
    }
  }
}

TEST(Undo, LeavesWhatWasMetOnTheWay) {
  const auto d = testing::drive(Model::hughes1992, 10, 33);
  const MapParams params{.rule = Rule::dempster_log};
  Map map = mapped(*d, params, d->scans);
  const Map before = mapped(*d, params, d->scans);
  map.undo(d->scans.back());
  for (std::int64_t y = -20; y < 80; ++y)
    for (std::int64_t x = -20; x < 80; ++x) ASSERT_EQ(map.conflict({x, y}), before.conflict({x, y}));
  EXPECT_NE(map.hash(), before.hash());
}

TEST(Undo, MakesNoTilesWhereTheyWereForgotten) {
  const auto d = testing::drive(Model::li2014, 24, 34);
  const CellRect left{-6400, -6400, 6400, 12800}, all{-6400, -6400, 12800, 12800};  // along the tiles
  for (const Rule rule : {Rule::dempster_log, Rule::murphy}) {
    const MapParams params{.rule = rule};
    Map map = mapped(*d, params, d->scans);
    map.clear(left);
    Map kept = mapped(*d, params, d->scans);
    kept.undo(d->scans.back());
    kept.clear(left);
    const std::size_t tiles = map.tiles();
    const std::uint64_t version = map.version();
    const Report back = map.undo(d->scans.back());
    EXPECT_GT(back.cells_updated, 0U);
    EXPECT_EQ(map.tiles(), tiles);
    EXPECT_EQ(map.hash(), kept.hash());
    EXPECT_TRUE(cells_of(map) == cells_of(kept));
    for (const CellRect& r : map.changes(version).rects) EXPECT_GE(r.x, 0);
    map.clear(all);
    const std::uint64_t empty = map.version();
    EXPECT_EQ(map.undo(d->scans).cells_updated, 0U);  // under sonars and laser: nothing is there
    EXPECT_EQ(map.tiles(), 0U);
    EXPECT_EQ(map.version(), empty);
    EXPECT_TRUE(map.changes(empty).rects.empty());
    map.integrate(d->scans);  // owes nothing for what was taken back from nowhere
    EXPECT_EQ(map.hash(), mapped(*d, params, d->scans).hash());
  }
}

TEST(Undo, IsRefusedWhereCellsAreNoSums) {
  for (const Rule rule : map_rules()) {
    Map map({.rule = rule}, make_serial_executor());
    if (rule == Rule::dempster_log || rule == Rule::murphy) {
      EXPECT_NO_THROW(map.undo(Scan{}));
    } else {
      EXPECT_THROW(map.undo(Scan{}), std::logic_error) << name(rule);
    }
  }
}

TEST(Cautious, TheSameScansAgainChangeNoBit) {
  const auto d = testing::drive(Model::li2014, 15, 34);
  const MapParams params{.rule = Rule::cautious, .keep_conflict = false};
  Map map = mapped(*d, params, d->scans);
  const std::string once = cells_of(map);
  map.integrate(d->scans);
  EXPECT_TRUE(cells_of(map) == once);
}

// Bayes with PlP-matched likelihoods and prior ½ is the PlP of Dempster's rule.
TEST(Bayes, ByPlausibilitiesIsThePlpOfDempster) {
  const auto d = testing::drive(Model::hughes1992, 25, 35);
  const Map bayes = mapped(*d, {.rule = Rule::bayes, .bayes = {Likelihood::plp, 1e-9, 1 - 1e-9}}, d->scans);
  const Map dempster = mapped(*d, {.rule = Rule::dempster_log}, d->scans);
  const Map by_betp = mapped(*d, {.rule = Rule::bayes, .bayes = {Likelihood::betp, 1e-9, 1 - 1e-9}}, d->scans);
  const CellRect r = dempster.bounds();
  std::vector<float> p(static_cast<std::size_t>(r.width * r.height)), plp = p, other = p;
  bayes.render(Layer::betp, r, p, r.width);
  dempster.render(Layer::plp, r, plp, r.width);
  by_betp.render(Layer::betp, r, other, r.width);
  double worst = 0, apart = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    worst = std::max(worst, std::fabs(static_cast<double>(p[i]) - plp[i]));
    apart = std::max(apart, std::fabs(static_cast<double>(p[i]) - other[i]));
  }
  EXPECT_LE(worst, 2e-6);
  EXPECT_GE(apart, 0.05);
}

TEST(Bayes, StaysWithinItsLimits) {
  const auto d = testing::drive(Model::hughes1992, 40, 36);
  const Map map = mapped(*d, {.rule = Rule::bayes, .bayes = {Likelihood::betp, 0.12, 0.97}}, d->scans);
  const CellRect r = map.bounds();
  std::vector<float> p(static_cast<std::size_t>(r.width * r.height));
  map.render(Layer::betp, r, p, r.width);
  const auto [low, high] = std::minmax_element(p.begin(), p.end());
  EXPECT_NEAR(*low, 0.12, 1e-6);
  EXPECT_NEAR(*high, 0.97, 1e-6);
}

/// One laser beam along x over and over: what m(occupied) of 0.6 at the wall and m(empty) of 0.6 there do to a cell.
struct Duel {
  Map map;
  SensorId near, far;
  explicit Duel(const MapParams& p) : map(p, make_serial_executor()) {
    Sensor s;
    s.model = Model::beam;
    s.beams = 1, s.beam_step_rad = 0.5, s.min_range_m = 0.01, s.max_range_m = 100;
    s.beam = {.empty = 0.6 / (1 - 1.05 / 200),
              .occupied = 0.6 / (1 - 1.05 / 200),
              .empty_margin_m = 0.15,
              .occupied_half_width_m = 0.1};
    near = far = map.add(s);
  }
  void tell(bool occupied) {
    const float range_m = occupied ? 1.05F : 3.0F;
    const Reading r{near, {&range_m, 1}};
    map.integrate(Scan{0, {0, 0.05, 0}, {&r, 1}});
  }
  [[nodiscard]] Mass cell() const { return map.mass({10, 0}); }  // its centre is 1.05 m ahead
};
int to_flip(Rule rule, int agreeing) {
  Duel duel({.cell_m = 0.1, .rule = rule});
  for (int i = 0; i < agreeing; ++i) duel.tell(false);
  int n = 0;
  for (; n < 2 * agreeing + 10 && !(duel.cell().o > duel.cell().e + 1e-5F); ++n) duel.tell(true);
  return n;
}

TEST(Duel, ReadingsToFlipACellAfterManyAgreeing) {
  EXPECT_EQ(to_flip(Rule::yager, 20), 2);
  EXPECT_EQ(to_flip(Rule::pcr5, 20), 3);
  EXPECT_EQ(to_flip(Rule::dempster_log, 20), 21);
  EXPECT_EQ(to_flip(Rule::dempster_log, 1000), 1001);  // where masses have long lost count
  EXPECT_GT(to_flip(Rule::dempster, 1000), 1001);
  EXPECT_EQ(to_flip(Rule::fuzzy, 3), 4);
}

TEST(History, ConAndTheLastConflictAreThoseOfTheUpdates) {
  for (const Rule rule : {Rule::dempster, Rule::pcr5, Rule::bayes, Rule::conjunctive}) {
    Duel duel({.cell_m = 0.1, .rule = rule, .keep_con = true, .keep_last_conflict = true});
    double sum = 0, con = 0, k = 0;
    for (int i = 0; i < 12; ++i) {
      const float before = duel.map.conflict({10, 0});
      duel.tell(i % 3 == 0);
      k = static_cast<double>(duel.map.conflict({10, 0})) - before;
      sum += k, con -= std::log1p(-k);
      ASSERT_NEAR(duel.map.last_conflict({10, 0}), k, 1e-6) << name(rule);
      ASSERT_NEAR(duel.map.con({10, 0}), con, 1e-5) << name(rule);
    }
    EXPECT_GT(sum, 0.3);
    std::vector<float> one(1);
    duel.map.render(Layer::con, {10, 0, 1, 1}, one, 1);
    EXPECT_EQ(one[0], duel.map.con({10, 0}));
    duel.map.render(Layer::last_conflict, {10, 0, 1, 1}, one, 1);
    EXPECT_EQ(one[0], duel.map.last_conflict({10, 0}));
  }
  EXPECT_FALSE(check(MapParams{.keep_conflict = false, .keep_con = true}).empty());
  EXPECT_FALSE(check(MapParams{.keep_conflict = false, .keep_last_conflict = true}).empty());
  EXPECT_FALSE(check(MapParams{.bayes = {.least_p = 0.5, .most_p = 0.5}}).empty());
}

}  // namespace
}  // namespace evigrid
