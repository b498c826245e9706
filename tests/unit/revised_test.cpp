// SPDX-License-Identifier: Apache-2.0
// Learned revision inside maps: what a cell hears, bits over kernels, threads and batches, files, and what is refused.
// Whole maps against the slow reference: tests/oracle/reference_cone_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "equivalence/random_scans.hpp"

namespace evigrid {
namespace {

std::shared_ptr<RevisionNetwork> some_network() {
  auto network = std::make_shared<RevisionNetwork>();
  for (std::size_t i = 0; i < network->weight.size(); ++i)
    network->weight[i] = 3 * std::sin(1 + 7.3 * static_cast<double>(i));
  return network;
}

/// Answers (0, 1, 0, 0) whatever it is told.
std::shared_ptr<RevisionNetwork> always_occupied() {
  auto network = std::make_shared<RevisionNetwork>();
  constexpr std::size_t kFirst = RevisionNetwork::kHidden * (RevisionNetwork::kIn + 1),
                        kRow = RevisionNetwork::kHidden + 1;
  for (std::size_t o = 0; o < 4; ++o) network->weight[kFirst + o * kRow + RevisionNetwork::kHidden] = o == 1 ? 60 : -60;
  return network;
}

TEST(Revised, IsWhatTheNetworkSaysOfTheModelledMasses) {
  Sensor s;
  s.revision = some_network();
  const ModelMass modelled = evaluate(s, 2, 1.5, 0);
  const ModelMass want = revise(*s.revision, modelled);
  EXPECT_NEAR(want.e + want.o + want.u + want.c, 1, 1e-15);
  EXPECT_GT(std::fabs(want.e - modelled.e) + std::fabs(want.o - modelled.o) + std::fabs(want.u - modelled.u) +
                std::fabs(want.c - modelled.c),
            0.1);  // the network does something
  Map map({.cell_m = 0.05, .rule = Rule::dempster}, make_serial_executor());  // the rule drops c
  const float range_m = 2;
  const Reading reading{map.add(s), {&range_m, 1}};
  map.integrate(Scan{0, {0.025, 0.025, 0}, {&reading, 1}});
  const Mass m = map.mass({30, 0});  // its centre is 1.5 m ahead
  const double rest = 1 - want.c;
  EXPECT_NEAR(m.e, want.e / rest, 2e-6);
  EXPECT_NEAR(m.o, want.o / rest, 2e-6);
  EXPECT_NEAR(m.u, want.u / rest, 2e-6);
  EXPECT_EQ(map.mass({60, 0}).u, 1);  // outside the model's support nothing is revised
}

TEST(Revised, AnExtremeNetworkStillGivesMasses) {
  Sensor s;
  s.revision = always_occupied();
  for (const Rule rule : {Rule::dempster, Rule::pcr5, Rule::yager, Rule::germ_pcr2}) {
    Map map({.rule = rule}, make_serial_executor());
    const float range_m = 2;
    const Reading reading{map.add(s), {&range_m, 1}};
    for (int i = 0; i < 3; ++i) map.integrate(Scan{i, {0.025, 0.025, 0}, {&reading, 1}});
    const Mass m = map.mass({20, 0});
    EXPECT_NEAR(m.o, 1, 1e-6) << name(rule);
    EXPECT_NEAR(m.e + m.o + m.u, 1, 4e-7) << name(rule);
  }
}

TEST(Revised, SameBitsForEveryKernelExecutorAndBatch) {
  auto d = testing::drive(Model::li2014, 16, 29);
  int n = 0;
  for (Sensor& s : d->sensors) {
    if (s.model == Model::beam) continue;
    if (n % 3 != 2) s.revision = some_network();
    if (n % 4 == 3) s.dependence = Dependence::cautious;
    ++n;
  }
  ASSERT_GT(n, 3);
  for (const Rule rule : {Rule::dempster, Rule::pcr5, Rule::germ_pcr2, Rule::conjunctive}) {
    for (const double decay_s : {0.0, 1.0}) {
      MapParams params{.rule = rule, .keep_con = true, .keep_last_conflict = true, .decay_s = decay_s};
      const auto first = testing::fuse(*d, params, make_serial_executor());
      for (const Kernel kernel : {Kernel::scalar, Kernel::avx2, Kernel::avx512}) {
        if (!kernel_available(kernel)) continue;
        params.kernel = kernel;
        for (const std::size_t batch : {1U, 16U})
          EXPECT_EQ(testing::fuse(*d, params, make_tbb_executor(2), batch).hash, first.hash)
              << name(rule) << ' ' << name(kernel) << ' ' << batch;
      }
    }
  }
}

TEST(Revised, ASavedMapKeepsTheNetwork) {
  Map map({.rule = Rule::pcr5}, make_serial_executor());
  Sensor s;
  s.revision = some_network();
  map.add(s);
  map.add(Sensor{});
  std::ostringstream out;
  save(map, out);
  std::string bytes = out.str();
  const Map loaded = load(std::as_bytes(std::span(bytes)));
  ASSERT_EQ(loaded.sensors().size(), 2U);
  ASSERT_NE(loaded.sensors()[0].revision, nullptr);
  EXPECT_EQ(loaded.sensors()[0].revision->weight, s.revision->weight);
  EXPECT_EQ(loaded.sensors()[1].revision, nullptr);
}

TEST(Revised, BadOnesAreRefusedByName) {
  Sensor s;
  s.revision = some_network();
  EXPECT_TRUE(check(s).empty());
  for (const Rule rule : {Rule::bayes, Rule::murphy, Rule::cautious, Rule::dempster_log, Rule::fuzzy}) {
    Map map({.rule = rule}, make_serial_executor());
    EXPECT_THROW(map.add(s), std::invalid_argument) << name(rule);
  }
  for (const Model model : {Model::probability, Model::fuzzy, Model::moravec1985}) {
    s.model = model;
    ASSERT_EQ(check(s).size(), 1U) << name(model);
    EXPECT_EQ(check(s)[0].field, "sensor.revision");
  }
  s.model = Model::li2014;
  for (const double bad : {static_cast<double>(NAN), static_cast<double>(INFINITY), 1e101}) {
    auto network = some_network();
    network->weight[7] = bad;
    s.revision = network;
    EXPECT_EQ(check(s).size(), 1U) << bad;
  }
}

}  // namespace
}  // namespace evigrid
