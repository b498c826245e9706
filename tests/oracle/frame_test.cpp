// SPDX-License-Identifier: Apache-2.0
// The general frame: printed values, the two-hypothesis rules as a special case, and definitions by exact rationals.
#include "evigrid/frame.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <random>

#include "evigrid/joint.hpp"
#include "tests/oracle/set_rules.hpp"

namespace {

using evigrid::Belief;
using evigrid::Frame;
using evigrid::Rule;
using evigrid::Subset;

const Frame& abc() {
  static const Frame frame({"A", "B", "C"});
  return frame;
}
std::vector<Belief> two(const Frame& frame, std::initializer_list<std::pair<std::string_view, double>> a,
                        std::initializer_list<std::pair<std::string_view, double>> b) {
  return {make_belief(frame, a), make_belief(frame, b)};
}
void expect_masses(Rule rule, const Frame& frame, const std::vector<Belief>& sources,
                   std::initializer_list<std::pair<std::string_view, double>> want, double tolerance) {
  const auto got = evigrid::combine(rule, frame, sources);
  double named = 0;
  for (const auto& [set, mass] : want) {
    EXPECT_NEAR(got.belief.m[frame.parse(set)], mass, tolerance) << name(rule) << ' ' << set;
    named += got.belief.m[frame.parse(set)];
  }
  EXPECT_NEAR(named, 1, 1e-12) << name(rule) << ": mass on other sets";
}

// Smarandache & Dezert, Proportional Conflict Redistribution Rules for Information Fusion (2004; chapter 1 of vol. 2,
// 2006), section 12.
TEST(FramePublished, SmarandacheDezert2004BayesianSources) {
  const auto m = two(abc(), {{"A", .6}, {"B", .3}, {"C", .1}}, {{"A", .4}, {"B", .4}, {"C", .2}});
  expect_masses(Rule::pcr1, abc(), m, {{"A", .550}, {"B", .337}, {"C", .113}}, 5e-4);
  expect_masses(Rule::pcr2, abc(), m, {{"A", .550}, {"B", .337}, {"C", .113}}, 5e-4);
  expect_masses(Rule::pcr3, abc(), m, {{"A", .574842}, {"B", .338235}, {"C", .086923}}, 1e-6);
  expect_masses(Rule::pcr4, abc(), m, {{"A", .627692}, {"B", .325714}, {"C", .046594}}, 1e-6);
  expect_masses(Rule::pcr5, abc(), m, {{"A", .574571}, {"B", .335429}, {"C", .090}}, 1e-6);
  auto more = m;
  more.push_back(vacuous(abc()));  // section 9.4: PCR3 with a vacuous source
  expect_masses(Rule::pcr3, abc(), more, {{"A", .574842}, {"B", .338235}, {"C", .086923}}, 1e-6);
}
TEST(FramePublished, ZadehsExample) {
  const auto m = two(abc(), {{"A", .9}, {"C", .1}}, {{"B", .9}, {"C", .1}});
  EXPECT_NEAR(combine(Rule::dempster, abc(), m).conflict, .99, 1e-12);
  expect_masses(Rule::dempster, abc(), m, {{"C", 1}}, 1e-12);
  expect_masses(Rule::yager, abc(), m, {{"C", .01}, {"*", .99}}, 1e-12);
  expect_masses(Rule::dubois_prade, abc(), m, {{"A|B", .81}, {"C", .01}, {"A|C", .09}, {"B|C", .09}}, 1e-12);
  expect_masses(Rule::pcr1, abc(), m, {{"A", .4455}, {"B", .4455}, {"C", .1090}}, 5e-5);
  expect_masses(Rule::pcr2, abc(), m, {{"A", .4455}, {"B", .4455}, {"C", .1090}}, 5e-5);
  expect_masses(Rule::pcr3, abc(), m, {{"A", .478636}, {"B", .478636}, {"C", .042728}}, 1e-6);
  expect_masses(Rule::pcr4, abc(), m, {{"A", .478636}, {"B", .478636}, {"C", .042728}}, 1e-6);
  expect_masses(Rule::pcr5, abc(), m, {{"A", .486}, {"B", .486}, {"C", .028}}, 1e-12);
  expect_masses(Rule::pcr6, abc(), m, {{"A", .486}, {"B", .486}, {"C", .028}}, 1e-12);
}
TEST(FramePublished, BetPAndDSmPOfOneBelief) {
  const Frame frame({"A", "B"});
  const Belief m = make_belief(frame, {{"A", .4}});
  EXPECT_NEAR(pignistic(frame, m, frame.parse("A")), .7, 1e-15);
  EXPECT_NEAR(dsmp(frame, m, frame.parse("A"), .001), .9985, 5e-5);
  EXPECT_NEAR(dsmp(frame, m, frame.parse("B"), .001), .0015, 5e-5);
  EXPECT_EQ(decide(frame, m), 0U);
  EXPECT_EQ(decide(frame, m, .8), 2U);
}

Belief random_belief(const Frame& frame, std::mt19937_64& engine, bool open = false) {
  std::uniform_real_distribution<double> unit(0, 1);
  Belief b{std::vector<double>(frame.subsets())};
  double sum = 0;
  for (Subset x = open ? 0 : 1; x < b.m.size(); ++x) {
    if ((x == 0 || frame.has(x)) && engine() % 3 != 0) sum += b.m[x] = unit(engine);
  }
  if (sum == 0) return vacuous(frame);
  for (double& m : b.m) m /= sum;
  return b;
}

// The rules of the definitions in set_rules.hpp, two sources on three and four hypotheses.
template <unsigned Parts>
void expect_definitions(unsigned seed) {
  std::vector<std::string> names;
  oracle::Frame by_parts;
  for (unsigned i = 0; i < Parts; ++i) {
    names.push_back(std::string(1, static_cast<char>('A' + i)));
    by_parts.hypotheses.push_back(1U << i);
  }
  const Frame frame(names);
  std::mt19937_64 engine(seed);
  for (int n = 0; n < 40; ++n) {
    const std::vector<Belief> m{random_belief(frame, engine), random_belief(frame, engine)};
    oracle::Belief<mpq_class, Parts> a, b;
    for (unsigned x = 0; x < a.size(); ++x) a[x] = m[0].m[x], b[x] = m[1].m[x];
    for (Rule rule : {Rule::dempster, Rule::yager, Rule::dubois_prade, Rule::pcr1, Rule::pcr2, Rule::pcr3, Rule::pcr4,
                      Rule::pcr5, Rule::pcr6, Rule::pcr5plus, Rule::pcr6plus, Rule::disjunctive, Rule::murphy}) {
      const auto want = oracle::combine<mpq_class, Parts>(rule, by_parts, a, b);
      const auto got = evigrid::combine(rule, frame, m);
      for (unsigned x = 1; x < a.size(); ++x)
        ASSERT_NEAR(got.belief.m[x], want.m[x].get_d(), 2e-15) << name(rule) << ' ' << frame.text(x);
    }
  }
}
TEST(FrameOracle, ThreeHypotheses) { expect_definitions<3>(1); }
TEST(FrameOracle, FourHypotheses) { expect_definitions<4>(2); }

TEST(FrameFacts, TwoHypothesesAreTheCells) {
  const Frame frame({"empty", "occupied"});
  std::mt19937_64 engine(3);
  for (int n = 0; n < 200; ++n) {
    std::vector<Belief> m;
    std::vector<std::array<double, 3>> cells;
    std::vector<evigrid::Planes<const double>> planes;
    for (int s = 0; s < 2 + n % 3; ++s) {
      m.push_back(random_belief(frame, engine));
      cells.push_back({m.back().m[1], m.back().m[2], m.back().m[3]});
    }
    for (const auto& c : cells) planes.push_back({c.data(), c.data() + 1, c.data() + 2, nullptr});
    for (Rule rule : evigrid::all_rules()) {
      if (!evigrid::has_joint_form(rule)) continue;
      double e = 0, o = 0, u = 0, k = 0;
      evigrid::combine_joint(rule, planes, {&e, &o, &u, nullptr}, &k, 1);
      const auto got = evigrid::combine(rule, frame, m);
      ASSERT_NEAR(got.belief.m[1], e, 2e-15) << name(rule);
      ASSERT_NEAR(got.belief.m[2], o, 2e-15) << name(rule);
      ASSERT_NEAR(got.belief.m[3], u, 2e-15) << name(rule);
      ASSERT_NEAR(got.conflict, k, 2e-15) << name(rule);
    }
  }
}

// The hyper-power set of two: what conflicts under Shafer's model stays on the intersection, and the pignistic
// probability is the generalised one.
TEST(FrameFacts, HyperPowerSetOfTwo) {
  const Frame frame = Frame::free_model("A", "B");
  const auto m = two(frame, {{"A", .6}}, {{"B", .3}});
  expect_masses(Rule::dsmc, frame, m, {{"A", .42}, {"B", .12}, {"*", .28}, {"A&B", .18}}, 1e-12);
  EXPECT_EQ(combine(Rule::dsmc, frame, m).conflict, 0);
  const Belief b = make_belief(frame, {{"A", .2}, {"B", .3}, {"A&B", .1}});  // the rest, .4, is unknown
  EXPECT_NEAR(pignistic(frame, b, frame.parse("B")), .3 + .1 + .2 / 2 + 2 * .4 / 3, 1e-15);
  EXPECT_NEAR(pignistic(frame, b, frame.parse("A&B")), .1 + (.2 + .3) / 2 + .4 / 3, 1e-15);
  EXPECT_THROW((void)dsmp(frame, b, 1), std::invalid_argument);
}

TEST(FrameFacts, BeliefPlausibilityCommonality) {
  const Belief b = make_belief(abc(), {{"A", .5}, {"A|B", .2}, {"C", .1}});
  const Subset a = abc().parse("A"), ab = abc().parse("B|A");
  EXPECT_NEAR(belief(abc(), b, ab), .7, 1e-15);
  EXPECT_NEAR(plausibility(abc(), b, a), .9, 1e-15);
  EXPECT_NEAR(commonality(abc(), b, ab), .4, 1e-15);
  const Belief half = discount(abc(), b, .5);
  EXPECT_NEAR(half.m[a], .25, 1e-15);
  EXPECT_NEAR(half.m[abc().everything()], .6, 1e-15);
}

// A tuple of A, B and A|B conflicts because of A and B; PCR5+ and PCR2 to PCR4 leave A|B out, PCR5 does not.
TEST(FrameFacts, WhatContainsTheOthersGetsNoShare) {
  std::vector<Belief> m;
  for (const char* set : {"A", "B", "A|B"}) m.push_back(make_belief(abc(), {{set, 1}}));
  for (Rule rule : {Rule::pcr2, Rule::pcr3, Rule::pcr4, Rule::pcr5plus, Rule::pcr6plus})
    expect_masses(rule, abc(), m, {{"A", .5}, {"B", .5}}, 1e-12);
  expect_masses(Rule::pcr5, abc(), m, {{"A", 1. / 3}, {"B", 1. / 3}, {"A|B", 1. / 3}}, 1e-12);
}

TEST(FrameFacts, AssociativeRulesMayTakeAllAtOnce) {
  std::mt19937_64 engine(4);
  for (int n = 0; n < 50; ++n) {
    const std::vector<Belief> m{random_belief(abc(), engine, true), random_belief(abc(), engine, true),
                                random_belief(abc(), engine, true)};
    const auto all = evigrid::combine(Rule::conjunctive, abc(), m);
    const auto first = evigrid::combine(Rule::conjunctive, abc(), std::span(m).first(2));
    const auto then = evigrid::combine(Rule::conjunctive, abc(), std::vector<Belief>{first.belief, m[2]});
    for (Subset x = 0; x < abc().subsets(); ++x) EXPECT_NEAR(all.belief.m[x], then.belief.m[x], 1e-15);
  }
}

TEST(FrameInput, IsRefusedByName) {
  EXPECT_THROW(Frame({}), std::invalid_argument);
  EXPECT_THROW(Frame({"A", "A"}), std::invalid_argument);
  EXPECT_THROW(Frame({"A|B"}), std::invalid_argument);
  EXPECT_THROW(Frame(std::vector<std::string>(9, "x")), std::invalid_argument);
  EXPECT_THROW((void)abc().parse("D"), std::invalid_argument);
  EXPECT_THROW((void)abc().parse("A&B"), std::invalid_argument);
  EXPECT_THROW((void)make_belief(abc(), {{"A", .7}, {"B", .7}}), std::invalid_argument);
  const auto m = two(abc(), {{"A", .6}}, {{"B", .3}});
  EXPECT_THROW((void)combine(Rule::bayes, abc(), m), std::invalid_argument);
  EXPECT_THROW((void)combine(Rule::pcr5, abc(), {}), std::invalid_argument);
  EXPECT_THROW((void)combine(Rule::pcr5, Frame({"A", "B"}), m), std::invalid_argument);
  try {
    auto bad = m;
    bad[1].m[1] = -0.1;
    (void)combine(Rule::pcr5, abc(), bad);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("source 2"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find('A'), std::string::npos);
  }
  EXPECT_TRUE(combine(Rule::dempster, abc(), two(abc(), {{"A", 1}}, {{"B", 1}})).total_conflict);
}

TEST(FrameInput, NamesOfSets) {
  for (Subset x = 0; x < abc().subsets(); ++x) EXPECT_EQ(abc().parse(abc().text(x)), x);
  const Frame free = Frame::free_model("A", "B");
  for (Subset x : {4U, 5U, 6U, 7U}) EXPECT_EQ(free.parse(free.text(x)), x);
  EXPECT_EQ(free.text(4), "A&B");
  EXPECT_FALSE(free.has(1));
  EXPECT_EQ(abc().text(5), "A|C");
}

}  // namespace
