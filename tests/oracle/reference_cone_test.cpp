// SPDX-License-Identifier: Apache-2.0
// evigrid::Map against the slow reference on sonar cones: every heading, exactly aligned poses, rings in a row.
#include <numbers>
#include <random>

#include "evigrid/revision.hpp"
#include "tests/oracle/compare_maps.hpp"

namespace {

using namespace oracle;
using evigrid::MapParams;
using evigrid::Model;
using evigrid::Pose2;
using evigrid::Rule;
using evigrid::Sensor;

constexpr double kDegree = std::numbers::pi / 180;

Sensor sonar(Model model, double aperture_deg) {
  Sensor s;
  s.model = model;
  s.aperture_rad = aperture_deg * kDegree;
  s.min_range_m = 0.1;
  s.max_range_m = 5;
  s.reliability = model == Model::li2014 ? 0.9 : 1;
  return s;
}

class ReferenceCone : public testing::TestWithParam<Model> {};

TEST_P(ReferenceCone, EveryHeadingByHalfDegrees) {
  for (double aperture_deg : {15.0, 25.0, 30.0}) {
    Difference all;
    for (int half = 0; half < 720; ++half) {
      const Rule rule = evigrid::map_rules()[half % evigrid::kMapRuleCount];
      const float range_m = 0.4F + 0.0061F * static_cast<float>(half);
      SCOPED_TRACE(testing::Message() << aperture_deg << " deg, heading " << half * 0.5 << ' ' << name(rule));
      all.merge(once({.cell_m = 0.1, .rule = rule}, sonar(GetParam(), aperture_deg),
                     {0.731 + 0.013 * half, -1.17, half * 0.5 * kDegree}, {&range_m, 1}));
    }
    expect_within_bounds(all);
    print(std::string(name(GetParam())) + " headings " + std::to_string(static_cast<int>(aperture_deg)), all);
  }
}

// Edges horizontal, vertical, diagonal and through centres; the apex on centres, corners, borders; arcs through
// centres.
TEST_P(ReferenceCone, ExactlyAlignedPoses) {
  const double cell = 0.125;
  for (double aperture_deg : {15.0, 25.0, 30.0}) {
    Difference all;
    for (double edge_rad : {0.0, 45 * kDegree, 90 * kDegree, 135 * kDegree, 180 * kDegree, 225 * kDegree, 270 * kDegree,
                            315 * kDegree, std::atan2(1, 2), std::atan2(2, 1), std::atan2(-3, 4)})
      for (double turn : {-0.5, 0.0, 0.5})  // the left edge, the axis, the right edge on that direction
        for (double ox : {0.0, 0.5, 0.25})
          for (double oy : {0.0, 0.5})
            for (float cells : {4.0F, 8.0F, 20.0F, 32.5F, 50.0F}) {
              const Pose2 pose{(3 + ox) * cell, (-7 + oy) * cell, edge_rad + turn * aperture_deg * kDegree};
              const float range_m = cells * static_cast<float>(cell);
              SCOPED_TRACE(testing::Message() << aperture_deg << " deg, pose " << pose.x_m << ' ' << pose.y_m << ' '
                                              << pose.yaw_rad << ", range " << range_m);
              Sensor s = sonar(GetParam(), aperture_deg);
              s.hughes.tolerance_m = 2 * cell;  // the arcs of both zones pass through centres
              s.oriolo.delta_m = 2 * cell, s.li2006.epsilon_m = cell;
              s.max_range_m = 8;  // li2014 reads 50 cells as far as exactly 51
              all.merge(once({.cell_m = cell}, s, pose, {&range_m, 1}));
            }
    expect_within_bounds(all);
    print(std::string(name(GetParam())) + " aligned " + std::to_string(static_cast<int>(aperture_deg)), all);
  }
}

/// A ring of `count` sonars at radius_m, driven along a random way: many readings of the same cells.
Difference drive_ring(Model model, Rule rule, double aperture_deg, double reliability, Pose2 start, double cell_m,
                      int scans, bool with_bad = false) {
  constexpr int kCount = 24;
  Both both({.cell_m = cell_m, .rule = rule});
  std::vector<evigrid::SensorId> ids;
  for (int i = 0; i < kCount; ++i) {
    Sensor s = sonar(model, aperture_deg);
    const double bearing = i * 2 * std::numbers::pi / kCount;
    s.T_robot_sensor = {0.353 * std::cos(bearing), 0.353 * std::sin(bearing), bearing};
    s.reliability = reliability;
    ids.push_back(both.add(s));
  }
  std::mt19937_64 engine(17);
  std::uniform_real_distribution<double> unit(0, 1);
  Pose2 pose = start;
  for (int n = 0; n < scans; ++n) {
    std::vector<float> ranges;
    for (int i = 0; i < kCount; ++i) ranges.push_back(static_cast<float>(0.1 + 3.9 * unit(engine)));
    if (with_bad) {
      ranges[0] = NAN, ranges[1] = -INFINITY, ranges[2] = INFINITY, ranges[3] = -2, ranges[4] = 0.05F;
      ranges[5] = 1000, ranges[6] = 5.5F, ranges[7] = 1e30F, ranges[8] = -0.0F, ranges[9] = 5.0F;
    }
    std::vector<evigrid::Reading> readings;
    for (int i = 0; i < kCount; ++i) readings.push_back({ids[i], {&ranges[i], 1}});
    if (with_bad) readings.push_back({99, {ranges.data(), 3}}), readings.push_back({ids[10], {ranges.data() + 10, 2}});
    both.integrate(evigrid::Scan{with_bad && n == 3 ? 0 : n + 1, pose, readings});
    pose.x_m += 0.06 * unit(engine), pose.y_m += 0.05 * unit(engine), pose.yaw_rad += 0.3 * (unit(engine) - 0.4);
  }
  both.expect_equal_reports();
  return both.difference();
}

TEST_P(ReferenceCone, RingScansInARowUnderEveryRule) {
  for (Rule rule : evigrid::map_rules())
    for (double reliability : {1.0, 0.9}) {
      const Difference d = drive_ring(GetParam(), rule, 25, reliability, {0.2, 0.1, 0.05}, 0.1, 30);
      SCOPED_TRACE(testing::Message() << name(rule) << " reliability " << reliability);
      EXPECT_GE(d.most_updates, 30U);
      Sensor of_ring = sonar(GetParam(), 25);
      of_ring.reliability = reliability;
      expect_within_bounds(d, mass_bound(rule, of_ring));
      print(std::string(name(GetParam())) + " ring " + std::string(name(rule)) + (reliability < 0.95 ? " 0.9" : " 1"),
            d);
    }
}

TEST_P(ReferenceCone, FiveSinglePassesUnderEveryRuleAndAperture) {
  for (Rule rule : evigrid::map_rules())
    for (double aperture_deg : {15.0, 30.0}) {
      SCOPED_TRACE(testing::Message() << name(rule) << ' ' << aperture_deg);
      expect_within_bounds(drive_ring(GetParam(), rule, aperture_deg, 0.95, {-3.3, 8.1, 2}, 0.05, 5));
    }
}

// Contextual discount before Shafer's, and the weights of conflict, reading by reading.
TEST_P(ReferenceCone, ContextualReliabilityAndCon) {
  for (Rule rule : {Rule::pcr5, Rule::germ_pcr2, Rule::yager, Rule::conjunctive, Rule::dempster_log, Rule::fuzzy}) {
    SCOPED_TRACE(std::string(name(rule)));
    Both both({.cell_m = 0.1, .rule = rule, .keep_con = true, .keep_last_conflict = true});
    Sensor s = sonar(GetParam(), 25), other = s;
    s.reliability_if_empty = 0.7, s.reliability_if_occupied = 0.9, s.reliability = 0.95;
    other.reliability_if_occupied = 0.4;
    const auto a = both.add(s), b = both.add(other);
    for (int i = 0; i < 24; ++i) {
      const float range_m = 0.7F + 0.15F * static_cast<float>(i % 9);
      both.integrate({0.05 * i, 0.031 * i, 0.2 * i}, i % 2 == 0 ? a : b, {&range_m, 1});
    }
    both.expect_equal_reports();
    expect_within_bounds(both.difference());
    for (const auto& [index, want] : both.reference().cells()) {
      ASSERT_NEAR(both.engine().con(index), want.con, 1e-5 * static_cast<double>(want.updates));
      ASSERT_NEAR(both.engine().last_conflict(index), want.last, 2e-6);
    }
  }
}

// Forgetting, with sensors of their own τ and scans that come late, reading by reading.
TEST_P(ReferenceCone, ForgetsByTime) {
  for (Rule rule :
       {Rule::dempster, Rule::pcr5, Rule::pcr1, Rule::germ_pcr2, Rule::yager, Rule::dsmh, Rule::conjunctive}) {
    SCOPED_TRACE(std::string(name(rule)));
    Both both({.cell_m = 0.1, .rule = rule, .decay_s = 2});
    Sensor s = sonar(GetParam(), 25), other = s;
    s.reliability = 0.95, other.reliability = 0.8, other.decay_s = 0.7;
    const auto a = both.add(s), b = both.add(other);
    for (int i = 0; i < 30; ++i) {
      const float range_m = 0.7F + 0.15F * static_cast<float>(i % 9);
      const evigrid::Reading reading{i % 3 == 0 ? b : a, {&range_m, 1}};
      const std::int64_t stamp_ns = (i % 7 == 6 ? i - 4 : i) * 133'000'000LL;
      both.integrate(evigrid::Scan{stamp_ns, {0.05 * i, 0.031 * i, 0.2 * i}, {&reading, 1}});
    }
    both.expect_equal_reports();
    const Difference d = both.difference();
    expect_within_bounds(d);
    print(std::string(name(GetParam())) + " forgetting " + std::string(name(rule)), d);
  }
}

// Scans whose readings are no distinct evidence: seven overlapping cones of each policy beside independent ones.
TEST_P(ReferenceCone, DependentReadingsOfOneScan) {
  using evigrid::Dependence;
  for (Rule rule : {Rule::dempster, Rule::pcr5, Rule::germ_pcr2, Rule::yager, Rule::dsmh, Rule::conjunctive}) {
    for (const double decay_s : {0.0, 2.0}) {
      SCOPED_TRACE(std::string(name(rule)));
      Both both({.cell_m = 0.1, .rule = rule, .decay_s = decay_s});
      std::vector<evigrid::SensorId> ids;
      for (int i = 0; i < 12; ++i) {
        Sensor s = sonar(GetParam(), 25);
        s.reliability = 0.9 - 0.02 * (i % 5);
        s.T_robot_sensor = {0.05, 0.02, -0.6 + 0.1 * i};
        s.dependence = static_cast<Dependence>(i % 4);
        if (s.dependence == Dependence::weighted) s.weight_exponent = i % 3 == 0 ? 0.25 : 0.6;
        ids.push_back(both.add(s));
      }
      for (int i = 0; i < 6; ++i) {
        std::vector<float> ranges_m(ids.size());
        std::vector<evigrid::Reading> readings;
        for (std::size_t k = 0; k < ids.size(); ++k) {
          ranges_m[k] = 1.0F + 0.07F * static_cast<float>((7 * k + 5 * static_cast<std::size_t>(i)) % 13);
          readings.push_back({ids[k], {&ranges_m[k], 1}});
        }
        both.integrate(evigrid::Scan{i * 400'000'000LL, {0.05 * i, 0.031 * i, 0.2 * i}, readings});
      }
      both.expect_equal_reports();
      const Difference d = both.difference();
      expect_within_bounds(d);
      print(std::string(name(GetParam())) + " dependent " + std::string(name(rule)), d);
    }
  }
}

// Sensors with a learned revision beside others, each policy, with and without forgetting.
TEST_P(ReferenceCone, RevisedReadings) {
  using evigrid::Dependence;
  auto network = std::make_shared<evigrid::RevisionNetwork>();
  for (std::size_t i = 0; i < network->weight.size(); ++i)
    network->weight[i] = 3 * std::sin(1 + 7.3 * static_cast<double>(i));
  for (Rule rule : {Rule::dempster, Rule::pcr5, Rule::pcr1, Rule::germ_pcr2, Rule::yager, Rule::conjunctive}) {
    for (const double decay_s : {0.0, 2.0}) {
      SCOPED_TRACE(std::string(name(rule)));
      Both both({.cell_m = 0.1, .rule = rule, .decay_s = decay_s});
      std::vector<evigrid::SensorId> ids;
      for (int i = 0; i < 12; ++i) {
        Sensor s = sonar(GetParam(), 25);
        s.reliability = 0.95 - 0.02 * (i % 5);
        s.T_robot_sensor = {0.05, 0.02, -0.6 + 0.1 * i};
        if (i % 3 != 2) s.revision = network;
        if (i % 4 == 3) s.dependence = static_cast<Dependence>(1 + i / 4);
        if (s.dependence == Dependence::weighted) s.weight_exponent = 0.6;
        ids.push_back(both.add(s));
      }
      for (int i = 0; i < 6; ++i) {
        std::vector<float> ranges_m(ids.size());
        std::vector<evigrid::Reading> readings;
        for (std::size_t k = 0; k < ids.size(); ++k) {
          ranges_m[k] = 1.0F + 0.07F * static_cast<float>((7 * k + 5 * static_cast<std::size_t>(i)) % 13);
          readings.push_back({ids[k], {&ranges_m[k], 1}});
        }
        both.integrate(evigrid::Scan{i * 400'000'000LL, {0.05 * i, 0.031 * i, 0.2 * i}, readings});
      }
      both.expect_equal_reports();
      const Difference d = both.difference();
      expect_within_bounds(d);
      print(std::string(name(GetParam())) + " revised " + std::string(name(rule)), d);
    }
  }
}

TEST_P(ReferenceCone, UtmSizedCoordinates) {
  for (double cell_m : {0.1, 0.05}) {
    const Difference d = drive_ring(GetParam(), Rule::pcr5, 25, 0.9, {500000.123, 5000000.456, 1.1}, cell_m, 8);
    expect_within_bounds(d);
    print(std::string(name(GetParam())) + " UTM cell " + std::to_string(cell_m), d);
  }
}

TEST_P(ReferenceCone, RefusedReadingsAreCountedByReason) {
  expect_within_bounds(drive_ring(GetParam(), Rule::pcr5, 25, 0.9, {0.2, 0.1, 0.05}, 0.1, 6, true));
}

TEST_P(ReferenceCone, NoFinitePoseRefusesEveryRange) {
  Both both(MapParams{});
  const auto id = both.add(sonar(GetParam(), 25));
  const float range_m = 2;
  both.integrate({NAN, 0, 0}, id, {&range_m, 1});
  both.integrate({0, INFINITY, 0}, id, {&range_m, 1});
  both.integrate({0, 0, NAN}, id, {&range_m, 1});
  both.expect_equal_reports();
  EXPECT_EQ(both.engine().bounds(), evigrid::CellRect{});
}

INSTANTIATE_TEST_SUITE_P(Models, ReferenceCone,
                         testing::Values(Model::hughes1992, Model::oriolo1997, Model::li2006, Model::li2014),
                         [](const auto& model) { return std::string(name(model.param)); });

// Models that say no masses, under the rules that are theirs.
TEST(ReferencePairs, ProbabilitiesAndMembershipsThroughTheirRules) {
  for (const auto& [model, rule] : {std::pair{Model::probability, Rule::bayes}, std::pair{Model::fuzzy, Rule::fuzzy},
                                    std::pair{Model::moravec1985, Rule::fuzzy}})
    for (double cell_m : {0.1, 0.05})
      for (double reliability : {1.0, 0.9}) {
        SCOPED_TRACE(testing::Message() << name(rule) << ' ' << name(model) << ' ' << cell_m);
        const Difference d = drive_ring(model, rule, 25, reliability, {0.2, 0.1, 0.05}, cell_m, 20);
        Sensor of_ring = sonar(model, 25);
        of_ring.reliability = reliability;
        // Near the sensor P is a hundredth, so that a float error of P counts a hundredfold in the odds.
        expect_within_bounds(d, std::max(mass_bound(rule, of_ring), model == Model::probability ? 4e-6 : 0));
        print(std::string(name(model)) + " " + std::string(name(rule)), d);
      }
}

// With likelihoods matched by plausibility and prior ½, Bayes is Dempster's PlP, for every model of masses.
TEST(ReferencePairs, BayesMatchedByPlPIsDempstersPlP) {
  for (Model model : {Model::hughes1992, Model::oriolo1997, Model::li2006, Model::li2014}) {
    MapParams by_bayes{.cell_m = 0.1, .rule = Rule::bayes};
    by_bayes.bayes = {.likelihood = evigrid::Likelihood::plp, .least_p = 1e-6, .most_p = 1 - 1e-6};
    evigrid::Map bayes(by_bayes), dempster({.cell_m = 0.1, .rule = Rule::dempster});
    Sensor s = sonar(model, 25);
    s.reliability = 0.8;
    const auto id = bayes.add(s), same = dempster.add(s);
    ASSERT_EQ(id, same);
    for (int n = 0; n < 9; ++n) {
      const float range_m = 1.2F + 0.13F * static_cast<float>(n % 4);
      const evigrid::Reading reading{id, {&range_m, 1}};
      const evigrid::Scan scan{n, {0.01 * n, 0.02 * n, 0.2 * n}, {&reading, 1}};
      bayes.integrate(scan), dempster.integrate(scan);
    }
    const evigrid::CellRect box = dempster.bounds();
    double worst = 0;
    int cells = 0;
    for (std::int64_t y = box.y; y < box.y + box.height; ++y)
      for (std::int64_t x = box.x; x < box.x + box.width; ++x) {
        const evigrid::Mass d = dempster.mass({x, y}), b = bayes.mass({x, y});
        if (d.u == 1) continue;
        const double plp = (static_cast<double>(d.o) + d.u) / (static_cast<double>(d.e) + d.o + 2.0 * d.u);
        worst = std::max(worst, std::fabs(plp - (b.o + b.u / 2.0)));
        ++cells;
      }
    EXPECT_GT(cells, 100) << name(model);
    EXPECT_LE(worst, 2e-6) << name(model);
  }
}

// A certain cell against certain evidence: Dempster answers with ignorance and counts it, the others share.
TEST(ReferenceCell, TotalConflictIsAnsweredAndCountedAlike) {
  for (Rule rule : evigrid::map_rules()) {
    SCOPED_TRACE(std::string(name(rule)));
    Sensor s = sonar(Model::li2014, 15);
    s.reliability = 1;
    s.li.rho_e = 0.3;
    Both both({.cell_m = 0.1, .rule = rule});
    const auto id = both.add(s);
    for (float range_m : {1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 5.0F}) both.integrate({0.013, 0.027, 0.4}, id, {&range_m, 1});
    both.expect_equal_reports();
    EXPECT_EQ(both.report().total_conflicts > 0, rule == Rule::dempster);
    expect_within_bounds(both.difference());
  }
}

// Only the division by the own sum and the floors of the state keep a cell normalised under an endless run.
TEST(ReferenceCell, SumsStayNearOneOverHundredThousandReadings) {
  for (Rule rule : evigrid::map_rules()) {
    evigrid::Map map({.cell_m = 0.5, .rule = rule});
    const auto id = map.add(sonar(Model::li2014, 15));
    double worst = 0;
    for (int n = 0; n < 100'000; ++n) {
      const float range_m = n % 3 == 0 ? 1.0F : 2.0F;
      const evigrid::Reading reading{id, {&range_m, 1}};
      map.integrate(evigrid::Scan{n, {0.25, 0.25, 0}, {&reading, 1}});
      const evigrid::Mass m = map.mass({2, 0});
      const double both = rule == Rule::fuzzy ? 2.0 * m.e * m.o : 0;  // memberships: 1 + 2 e o
      worst = std::max(worst, std::fabs(static_cast<double>(m.e) + m.o + m.u + m.c - 1 - both));
      ASSERT_TRUE(std::isfinite(m.e) && std::isfinite(m.o)) << name(rule);
      ASSERT_TRUE(m.u > 0 || rule == Rule::bayes || rule == Rule::fuzzy) << name(rule);
    }
    EXPECT_LE(worst, 4e-7) << name(rule);
  }
}

}  // namespace
