// SPDX-License-Identifier: Apache-2.0
// Policies for the readings of one scan: what each makes of two sonars that say the same, bits over kernels, threads
// and batches, files, and what is refused. Whole maps against the slow reference: tests/oracle.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "equivalence/random_scans.hpp"
#include "evigrid/combine.hpp"

namespace evigrid {
namespace {

constexpr CellIndex kAhead{10, 0};  // in the empty part of the cone

/// A map that `sonars` equal sonars told the same of 2 m ahead, in one scan.
Map heard(Rule rule, Dependence policy, int sonars, double exponent = 1) {
  Map map({.rule = rule}, make_serial_executor());
  Sensor s;
  s.model = Model::hughes1992;
  s.reliability = 0.9;
  s.dependence = policy;
  s.weight_exponent = exponent;
  const float range_m = 2;
  std::vector<Reading> readings;
  for (int i = 0; i < sonars; ++i) readings.push_back({map.add(s), {&range_m, 1}});
  map.integrate({.stamp_ns = 0, .T_map_robot = {0.025, 0.025, 0}, .readings = readings});
  return map;
}

TEST(Dependent, OneReadingIsAsIndependent) {
  for (const Rule rule : {Rule::dempster, Rule::pcr5, Rule::yager}) {
    const Mass alone = heard(rule, Dependence::independent, 1).mass(kAhead);
    for (const Dependence policy : {Dependence::cautious, Dependence::once_per_scan, Dependence::weighted}) {
      const Mass m = heard(rule, policy, 1).mass(kAhead);
      EXPECT_NEAR(m.e, alone.e, 2e-7) << name(policy);
      EXPECT_NEAR(m.u, alone.u, 2e-7) << name(policy);
    }
  }
}

TEST(Dependent, TheSameEvidenceTwiceCountsOnceOrByItsExponent) {
  for (const Rule rule : {Rule::dempster, Rule::pcr5, Rule::yager}) {
    const Mass once = heard(rule, Dependence::independent, 1).mass(kAhead);
    const Mass twice = heard(rule, Dependence::independent, 2).mass(kAhead);
    ASSERT_GT(twice.e, once.e + 0.05F);
    EXPECT_NEAR(heard(rule, Dependence::cautious, 5).mass(kAhead).e, once.e, 2e-7);
    EXPECT_NEAR(heard(rule, Dependence::once_per_scan, 5).mass(kAhead).e, once.e, 2e-7);
    EXPECT_NEAR(heard(rule, Dependence::weighted, 4, 0.25).mass(kAhead).e, once.e, 2e-7);
    EXPECT_NEAR(heard(rule, Dependence::weighted, 2, 1).mass(kAhead).e, twice.e, 2e-7);  // agreeing: every rule
    const double w = 1 - static_cast<double>(once.e);
    EXPECT_NEAR(heard(rule, Dependence::weighted, 1, 0.5).mass(kAhead).e, 1 - std::sqrt(w), 2e-7);
  }
}

TEST(Dependent, TheNextScanIsDistinct) {
  Map map = heard(Rule::dempster, Dependence::cautious, 3);
  const float before = map.mass(kAhead).e, range_m = 2;
  const Reading reading{0, {&range_m, 1}};
  map.integrate({.stamp_ns = 1, .T_map_robot = {0.025, 0.025, 0}, .readings = {&reading, 1}});
  EXPECT_NEAR(1 - map.mass(kAhead).e, std::pow(1 - before, 2), 2e-7);
}

TEST(Dependent, SameBitsForEveryKernelExecutorAndBatch) {
  for (const Model model : {Model::li2014, Model::hughes1992}) {
    auto d = testing::drive(model, 16, 23);
    for (std::size_t i = 0; i < d->sensors.size(); ++i) {
      d->sensors[i].dependence = static_cast<Dependence>((i + 1) % 4);  // the laser: cautious
      if (d->sensors[i].dependence == Dependence::weighted) d->sensors[i].weight_exponent = 0.4;
    }
    for (const Rule rule : {Rule::dempster, Rule::pcr5, Rule::germ_pcr2, Rule::conjunctive}) {
      for (const double decay_s : {0.0, 1.0}) {
        MapParams params{.rule = rule, .keep_con = true, .keep_last_conflict = true, .decay_s = decay_s};
        const auto first = testing::fuse(*d, params, make_serial_executor());
        for (const Kernel kernel : {Kernel::scalar, Kernel::avx2, Kernel::avx512}) {
          if (!kernel_available(kernel)) continue;
          params.kernel = kernel;
          for (const std::size_t batch : {1U, 16U}) {
            const auto other = testing::fuse(*d, params, make_tbb_executor(2), batch);
            EXPECT_EQ(other.hash, first.hash) << name(rule) << ' ' << name(kernel) << ' ' << batch;
            EXPECT_EQ(other.report.cells_updated, first.report.cells_updated);
          }
        }
      }
    }
  }
}

TEST(Dependent, ASavedMapKeepsThePolicy) {
  Map map = heard(Rule::pcr5, Dependence::weighted, 2, 0.25);
  std::ostringstream out;
  save(map, out);
  const std::string bytes = out.str();
  const Map loaded = load(std::as_bytes(std::span(bytes)));
  ASSERT_EQ(loaded.sensors().size(), 2U);
  EXPECT_EQ(loaded.sensors()[1].dependence, Dependence::weighted);
  EXPECT_EQ(loaded.sensors()[1].weight_exponent, 0.25);
}

TEST(Dependent, BadOnesAreRefusedByName) {
  Sensor s;
  s.dependence = Dependence::weighted;
  for (const double bad : {0.0, -1.0, 1.5, static_cast<double>(NAN)}) {
    s.weight_exponent = bad;
    ASSERT_EQ(check(s).size(), 1U) << bad;
    EXPECT_EQ(check(s)[0].field, "sensor.weight_exponent");
  }
  s.dependence = Dependence::cautious, s.weight_exponent = 0.5;
  ASSERT_EQ(check(s).size(), 1U);
  s.weight_exponent = 1, s.decay_s = 3;
  ASSERT_EQ(check(s).size(), 1U);
  EXPECT_EQ(check(s)[0].field, "sensor.decay_s");
  s.decay_s = 0;
  for (const Rule rule : {Rule::bayes, Rule::murphy, Rule::cautious, Rule::dempster_log}) {
    Map map({.rule = rule}, make_serial_executor());
    EXPECT_THROW(map.add(s), std::invalid_argument) << name(rule);
  }
  EXPECT_FALSE(dependence_from_name("twice"));
}

}  // namespace
}  // namespace evigrid
