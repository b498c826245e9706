// SPDX-License-Identifier: Apache-2.0
// Merging: against the map of both logs where the rule's state is a sum, against combine() cell by cell where it is
// not, and against a plain loop over centres where the pose is not aligned.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "equivalence/random_scans.hpp"
#include "evigrid/evigrid.hpp"

namespace evigrid {
namespace {

Map fused(const testing::Drive& d, MapParams params, std::size_t first, std::size_t count, double dx_m = 0,
          double dy_m = 0) {
  Map map(params, make_serial_executor());
  for (const Sensor& s : d.sensors) map.add(s);
  for (std::size_t i = first; i < first + count; ++i) {
    Scan s = d.scans[i];
    s.T_map_robot.x_m += dx_m, s.T_map_robot.y_m += dy_m;
    map.integrate(s);
  }
  return map;
}

constexpr CellRect kAll{-160, -260, 500, 560};
template <class F>
void each_cell(F&& f) {
  for (std::int64_t y = kAll.y; y < kAll.y + kAll.height; ++y) {
    for (std::int64_t x = kAll.x; x < kAll.x + kAll.width; ++x) f(CellIndex{x, y});
  }
}

TEST(Merge, OfSumsIsTheMapOfBothLogs) {
  const auto d = testing::drive(Model::li2014, 24, 3);
  for (const Rule rule : {Rule::dempster_log, Rule::murphy, Rule::cautious}) {
    const MapParams params{.rule = rule};
    Map a = fused(*d, params, 0, 10), b = fused(*d, params, 10, 14);
    const Map both = fused(*d, params, 0, 24);
    const MergeReport r = merge(a, b.view());
    EXPECT_EQ(a.hash(), both.hash()) << name(rule);
    EXPECT_TRUE(r.aligned);
    EXPECT_GT(r.cells, 1000u);
  }
}

TEST(Merge, AlignedIsCombineCellByCell) {
  const auto d = testing::drive(Model::li2014, 24, 5);
  for (const Rule rule : {Rule::pcr5, Rule::dempster, Rule::yager, Rule::conjunctive, Rule::pcr2}) {
    for (const double reliability : {1.0, 0.6}) {
      const MapParams params{.rule = rule};
      Map a = fused(*d, params, 0, 10), b = fused(*d, params, 10, 14);
      const Map before = fused(*d, params, 0, 10);
      const std::int64_t sx = 37, sy = -70;
      const MergeReport r = merge(a, b.view(), {{0.05 * sx, 0.05 * sy, 0}, reliability});
      EXPECT_TRUE(r.aligned);
      std::uint64_t met = 0;
      int wrong = 0;
      each_cell([&](CellIndex c) {
        const Mass m = before.mass(c), n = b.mass({c.x - sx, c.y - sy}), got = a.mass(c);
        met += !(n == Mass{});
        double x[4]{m.e, m.o, m.u, m.c}, k = 0;
        double y[4]{reliability * n.e, reliability * n.o, 1 - reliability * (1 - double{n.u}), reliability * n.c};
        combine(rule, Planes<const double>{x, x + 1, x + 2, x + 3}, Planes<const double>{y, y + 1, y + 2, y + 3},
                Planes<double>{x, x + 1, x + 2, x + 3}, &k, 1);
        const double off =
            std::abs(got.e - x[0]) + std::abs(got.o - x[1]) + std::abs(got.u - x[2]) + std::abs(got.c - x[3]) +
            (n == Mass{} ? 0
                         : std::abs(a.conflict(c) - before.conflict(c) - b.conflict({c.x - sx, c.y - sy}) - k) * 1e-2);
        wrong += !(off < 1e-6);
      });
      EXPECT_EQ(wrong, 0) << name(rule);
      EXPECT_EQ(r.cells, met);
    }
  }
}

TEST(Merge, AnyOtherPoseReadsTheCellUnderEachCentre) {
  const auto d = testing::drive(Model::li2014, 12, 8);
  const Pose2 pose{0.731, -1.207, 0.83};
  Map into({.rule = Rule::pcr5}, make_serial_executor());
  const Map from = fused(*d, {.rule = Rule::pcr5}, 0, 12);
  Map source = fused(*d, {.rule = Rule::pcr5}, 0, 12);
  const MergeReport r = merge(into, source.view(), {pose, 1});
  EXPECT_FALSE(r.aligned);
  int wrong = 0;
  std::uint64_t met = 0;
  each_cell([&](CellIndex c) {
    const double x = (static_cast<double>(c.x) + 0.5) * 0.05 - pose.x_m,
                 y = (static_cast<double>(c.y) + 0.5) * 0.05 - pose.y_m;
    const Mass wanted = from.mass(from.cell_at(std::cos(pose.yaw_rad) * x + std::sin(pose.yaw_rad) * y,
                                               std::cos(pose.yaw_rad) * y - std::sin(pose.yaw_rad) * x));
    met += !(wanted == Mass{});
    const Mass got = into.mass(c);  // combined with nothing: only the floors of a map are between
    wrong += std::abs(got.o - wanted.o) + std::abs(got.e - wanted.e) + std::abs(got.u - wanted.u) > 1e-6;
  });
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(r.cells, met);
  EXPECT_GT(met, 10000u);
}

TEST(Merge, BayesAddsLogOddsAndFuzzyJoins) {
  const auto d = testing::drive(Model::li2014, 12, 2);
  Map a = fused(*d, {.rule = Rule::bayes}, 0, 6), b = fused(*d, {.rule = Rule::bayes}, 6, 6);
  const Map before = fused(*d, {.rule = Rule::bayes}, 0, 6);
  merge(a, b.view());
  Map f({.rule = Rule::fuzzy}, make_serial_executor()), g({.rule = Rule::fuzzy}, make_serial_executor());
  f.write({0, 0, 1, 1}, std::vector<Mass>{{0.5f, 0.25f, 0}}, 1);
  g.write({0, 0, 1, 1}, std::vector<Mass>{{0.5f, 0.5f, 0}}, 1);
  merge(f, g.view(), {{}, 0.5});
  EXPECT_FLOAT_EQ(f.mass({0, 0}).e, 0.625f);   // ½ + ¼ − ½·¼
  EXPECT_FLOAT_EQ(f.mass({0, 0}).o, 0.4375f);  // ¼ + ¼ − ¼·¼
  int wrong = 0;
  each_cell([&](CellIndex c) {
    const auto log_odds = [](double p) { return std::log(p / (1 - p)); };
    if (before.mass(c) == Mass{} && b.mass(c) == Mass{}) return;
    const double mine = before.mass(c) == Mass{} ? 0.5 : before.mass(c).o,
                 theirs = b.mass(c) == Mass{} ? 0.5 : b.mass(c).o;
    const double q = std::clamp(1 / (1 + std::exp(-(log_odds(mine) + log_odds(theirs)))), 0.001, 0.999);
    wrong += std::abs(a.mass(c).o - q) > 1e-5;
  });
  EXPECT_EQ(wrong, 0);
}

TEST(Merge, MapsThatForgetSayWhatTheySayNow) {
  const auto d = testing::drive(Model::li2014, 12, 4);
  const MapParams params{.rule = Rule::pcr5, .decay_s = 20};
  Map a = fused(*d, params, 0, 6), b = fused(*d, params, 6, 6), before = fused(*d, params, 0, 6);
  b.advance_to(9'000'000'000), before.advance_to(9'000'000'000);
  merge(a, b.view());
  int wrong = 0;
  each_cell([&](CellIndex c) {
    const Mass m = before.mass(c), n = b.mass(c), got = a.mass(c);
    double x[3]{m.e, m.o, m.u}, y[3]{n.e, n.o, n.u}, k = 0;
    combine(Rule::pcr5, Planes<const double>{x, x + 1, x + 2}, Planes<const double>{y, y + 1, y + 2},
            Planes<double>{x, x + 1, x + 2}, &k, 1);
    wrong += !(std::abs(got.e - x[0]) + std::abs(got.o - x[1]) + std::abs(got.u - x[2]) < 1e-6);
  });
  EXPECT_EQ(wrong, 0);
  const Mass now = a.mass({20, 1});
  a.advance_to(30'000'000'000);
  EXPECT_LT(a.mass({20, 1}).e + a.mass({20, 1}).o, 0.5f * (now.e + now.o));
  EXPECT_GT(now.e + now.o, 0.1f);
}

TEST(Merge, ProtectedCellsThatHadFadedAwayKeepWhatIsMergedIntoThem) {
  const MapParams params{.rule = Rule::dempster, .decay_s = 1};
  Map into(params, make_serial_executor()), from(params, make_serial_executor());
  const SensorId id = into.add({});
  const float range_m = 2;
  const Reading reading{id, {&range_m, 1}};
  into.integrate(Scan{0, {}, {&reading, 1}});
  const CellIndex c = into.cell_at(1, 0);
  ASSERT_GT(into.mass(c).e, 0.5f);
  into.advance_to(200'000'000'000);  // two hundred times tau: nothing is left to freeze
  ASSERT_EQ(into.mass(c), Mass{});
  into.protect({c.x, c.y, 1, 1});
  from.write({c.x, c.y, 1, 1}, std::vector<Mass>{{0.5f, 0, 0.5f}}, 1);
  merge(into, from.view());
  EXPECT_EQ(into.mass(c).e, 0.5f);
  into.advance_to(300'000'000'000);
  EXPECT_EQ(into.mass(c).e, 0.5f);
}

// As a reading that contradicts the cell wholly: docs/maths.md.
TEST(Merge, TotalConflictWeighsAsMuchAsThatOfAReading) {
  for (const Rule rule : {Rule::dempster, Rule::yager, Rule::fuzzy}) {
    const MapParams params{.rule = rule, .keep_con = true};
    Map into(params, make_serial_executor()), from(params, make_serial_executor());
    into.write({0, 0, 1, 1}, std::vector<Mass>{{1, 0, 0}}, 1);
    from.write({0, 0, 1, 1}, std::vector<Mass>{{0, 1, 0}}, 1);
    merge(into, from.view());
    EXPECT_NEAR(into.con({0, 0}), -std::log(1e-12), 1e-4) << name(rule);
  }
}

TEST(Merge, ManyMapsInTheirOrderAndViewsStay) {
  const auto d = testing::drive(Model::li2014, 24, 6);
  const MapParams params{.rule = Rule::pcr5};
  std::vector<Map> parts;
  for (std::size_t i = 0; i < 4; ++i) parts.push_back(fused(*d, params, 6 * i, 6));
  const auto all = [&](std::vector<std::size_t> order, int threads) {
    Map out(params, make_openmp_executor(threads));
    const MapView nothing = out.view();
    for (const std::size_t i : order) merge(out, parts[i].view(), {{}, 0.9});
    EXPECT_EQ(nothing.tiles(), 0u);
    return out.hash();
  };
  EXPECT_EQ(all({0, 1, 2, 3}, 1), all({0, 1, 2, 3}, 3));
  EXPECT_NE(all({0, 1, 2, 3}, 1), all({3, 2, 1, 0}, 1));
}

TEST(Merge, WhatDoesNotFitIsNamed) {
  const auto message = [](MapParams a, MapParams b, MergeOptions o = {}) {
    Map into(a, make_serial_executor()), from(b, make_serial_executor());
    try {
      merge(into, from.view(), o);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(message({.cell_m = 0.1}, {.cell_m = 0.05}).find("different sizes"), std::string::npos);
  EXPECT_NE(message({}, {}, {{}, 0}).find("reliability"), std::string::npos);
  EXPECT_NE(message({}, {}, {{NAN, 0, 0}, 1}).find("pose"), std::string::npos);
  EXPECT_NE(message({.rule = Rule::fuzzy}, {.rule = Rule::pcr5}).find("memberships"), std::string::npos);
  EXPECT_NE(message({.rule = Rule::bayes}, {.rule = Rule::conjunctive}).find("no place"), std::string::npos);
  EXPECT_EQ(message({.rule = Rule::bayes}, {.rule = Rule::pcr5}), "");
}

TEST(Merge, WhatIsOldComesInAsOldAsItIs) {
  const MapParams params{.rule = Rule::dempster, .decay_s = 10};
  Map into(params, make_serial_executor()), from(params, make_serial_executor());
  const std::vector<Mass> wall{{0, 0.8f, 0.2f}};
  const auto hears = [](Map& map, std::int64_t stamp_ns, Pose2 at) {
    const SensorId id = map.add({});
    const float range_m = 2;
    const Reading reading{id, {&range_m, 1}};
    map.integrate(Scan{stamp_ns, at, {&reading, 1}});
  };
  hears(from, 0, {0, 0, 0});
  hears(into, 100'000'000'000, {50, 0, 0});  // ten times the map's tau later
  const CellIndex c = from.cell_at(1, 0);
  ASSERT_GT(from.mass(c).e, 0.5f);
  merge(into, from.view());
  EXPECT_NEAR(into.mass(c).e, from.mass(c).e * std::exp(-10.0), 1e-6);
}

TEST(Merge, ProtectedCellsAreNotForgottenAfterwards) {
  const auto d = testing::drive(Model::li2014, 12, 4);
  const MapParams params{.rule = Rule::pcr5, .decay_s = 20};
  Map into = fused(*d, params, 0, 6), from = fused(*d, params, 6, 6);
  const CellIndex guarded{20, 1}, other{20, 30};
  into.protect({0, 0, 25, 25});
  merge(into, from.view());
  const Mass now = into.mass(guarded);
  ASSERT_GT(now.e + now.o, 0.1f);
  into.advance_to(100'000'000'000);
  EXPECT_EQ(into.mass(guarded), now);
  EXPECT_LT(into.mass(other).e + into.mass(other).o, 0.05f);
}

TEST(Merge, AMergeThatDoesNotFitLeavesTimeAsItWas) {
  const MapParams params{.rule = Rule::dempster, .memory_cap_bytes = 1 << 20, .decay_s = 10};
  Map into(params, make_serial_executor()), from({.rule = Rule::dempster, .decay_s = 10}, make_serial_executor());
  const SensorId id = into.add({});
  const float range_m = 2;
  const Reading reading{id, {&range_m, 1}};
  into.integrate(Scan{0, {}, {&reading, 1}});
  const std::vector<Mass> wall{{0, 0.8f, 0.2f}};
  for (std::int64_t i = 0; i < 100; ++i) from.write({64 * i, 6400, 1, 1}, wall, 1);
  from.advance_to(100'000'000'000);
  const std::uint64_t before = into.hash();
  EXPECT_THROW(merge(into, from.view()), std::length_error);
  EXPECT_EQ(into.hash(), before);
}

}  // namespace
}  // namespace evigrid
