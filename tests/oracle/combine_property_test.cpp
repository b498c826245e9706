// SPDX-License-Identifier: Apache-2.0
// What every rule of evigrid::combine must keep bit for bit: order of the operands, mirror, kernels, executors,
// aliasing.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <iostream>
#include <limits>

#include "evigrid/frame.hpp"
#include "tests/oracle/mass_pairs.hpp"

namespace {

using namespace oracle;
using evigrid::Kernel;
using evigrid::Rule;

struct Result {
  MassArray<float> c;
  std::vector<float> conflict;
  std::uint64_t total = 0;
};

Result run(Rule rule, const MassArray<float>& a, const MassArray<float>& b, Kernel kernel,
           evigrid::Executor* executor = nullptr) {
  Result r{MassArray<float>(a.size(), true), std::vector<float>(a.size()), 0};
  r.total = evigrid::combine(rule, a.view(), b.view(), r.c.planes(), r.conflict.data(), a.size(), kernel, executor);
  return r;
}

// Two NaN count as the same here: that a result is a number is what the comparison with exact arithmetic tests.
bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](float x, float y) {
    return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y) || (std::isnan(x) && std::isnan(y));
  });
}
void expect_same(const Result& a, const Result& b) {
  EXPECT_TRUE(same_bits(a.c.e, b.c.e));
  EXPECT_TRUE(same_bits(a.c.o, b.c.o));
  EXPECT_TRUE(same_bits(a.c.u, b.c.u));
  EXPECT_TRUE(same_bits(a.c.c, b.c.c));
  EXPECT_TRUE(same_bits(a.conflict, b.conflict));
  EXPECT_EQ(a.total, b.total);
}

MassArray<float> mirror(const MassArray<float>& m) {
  MassArray<float> out = m;
  std::swap(out.e, out.o);
  return out;
}

class CombineProperty : public testing::TestWithParam<Rule> {
 protected:
  static Pairs<float> pairs() {
    Pairs<float> out = random_pairs<float>(20'000, 11), corner = corner_pairs<float>();
    for (std::size_t i = 0; i < corner.size(); ++i) {
      out.a.push(corner.a.e[i], corner.a.o[i], corner.a.u[i]);
      out.b.push(corner.b.e[i], corner.b.o[i], corner.b.u[i]);
    }
    return out;
  }
};

TEST_P(CombineProperty, CommutesBitForBit) {
  const auto [a, b] = pairs();
  for (Kernel kernel : available_kernels()) expect_same(run(GetParam(), a, b, kernel), run(GetParam(), b, a, kernel));
}

TEST_P(CombineProperty, MirrorsBitForBit) {
  const auto [a, b] = pairs();
  for (Kernel kernel : available_kernels()) {
    Result mirrored = run(GetParam(), mirror(a), mirror(b), kernel);
    std::swap(mirrored.c.e, mirrored.c.o);
    expect_same(run(GetParam(), a, b, kernel), mirrored);
  }
}

TEST_P(CombineProperty, EveryKernelAnswersTheBitsOfScalar) {
  const auto [a, b] = pairs();
  const Result scalar = run(GetParam(), a, b, Kernel::scalar);
  for (Kernel kernel : available_kernels()) {
    SCOPED_TRACE(std::string(name(kernel)));
    EXPECT_EQ(evigrid::resolve_kernel_name(kernel), name(kernel));
    expect_same(scalar, run(GetParam(), a, b, kernel));
  }
  expect_same(scalar, run(GetParam(), a, b, Kernel::automatic));
}

TEST_P(CombineProperty, EveryExecutorAnswersTheBitsOfNone) {
  const auto [a, b] = pairs();
  const Result alone = run(GetParam(), a, b, Kernel::automatic);
  for (const char* who : {"serial", "tbb", "openmp"})
    for (int threads : {1, 2, 7}) {
      SCOPED_TRACE(testing::Message() << who << ' ' << threads);
      const auto executor = evigrid::make_executor(who, threads);
      ASSERT_NE(executor, nullptr);
      expect_same(alone, run(GetParam(), a, b, Kernel::automatic, executor.get()));
    }
}

TEST_P(CombineProperty, InPlaceAndEveryLengthAnswerTheSame) {
  const auto [a, b] = pairs();
  for (Kernel kernel : available_kernels()) {
    const Result whole = run(GetParam(), a, b, kernel);
    for (std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{7}, std::size_t{8},
                          std::size_t{17}, std::size_t{33}, a.size()}) {
      Result in_place{a, std::vector<float>(a.size(), -1), 0};
      evigrid::combine(GetParam(), in_place.c.view(), b.view(), in_place.c.planes(), in_place.conflict.data(), n,
                       kernel);
      Result want{a, std::vector<float>(a.size(), -1), 0};
      std::copy_n(whole.c.e.begin(), n, want.c.e.begin());
      std::copy_n(whole.c.o.begin(), n, want.c.o.begin());
      std::copy_n(whole.c.u.begin(), n, want.c.u.begin());
      std::copy_n(whole.conflict.begin(), n, want.conflict.begin());
      SCOPED_TRACE(testing::Message() << name(kernel) << " length " << n);
      expect_same(want, in_place);
    }
  }
}

/// A vacuous source is neutral for the masses of every rule but these: bayes and fuzzy read masses as something else.
bool vacuous_is_neutral(Rule rule) {
  return rule != Rule::disjunctive && rule != Rule::murphy && rule != Rule::bayes && rule != Rule::fuzzy;
}

TEST_P(CombineProperty, VacuousChangesNothingWhereItIsNeutral) {
  std::mt19937_64 engine(3);
  MassArray<float> exact(0), rounded(0);  // multiples of 2^-23 add up to exactly 1 in every order
  for (int i = 0; i < 10'000; ++i) {
    const auto s = static_cast<std::uint32_t>(engine() % 0x800001U), t = static_cast<std::uint32_t>(engine() % (s + 1));
    exact.push(std::ldexp(static_cast<float>(t), -23), std::ldexp(static_cast<float>(s - t), -23),
               std::ldexp(static_cast<float>(0x800000U - s), -23));
    push_uniform(rounded, engine);
  }
  MassArray<float> vacuous(exact.size());
  std::fill(vacuous.u.begin(), vacuous.u.end(), 1.0F);
  const auto worst_ulps = [](const std::vector<float>& got, const std::vector<float>& want) {
    int worst = 0;
    for (std::size_t i = 0; i < got.size(); ++i)  // floats from 0 up are ordered as their bits
      worst = std::max(worst, std::abs(std::bit_cast<std::int32_t>(got[i]) - std::bit_cast<std::int32_t>(want[i])));
    return worst;
  };
  for (Kernel kernel : available_kernels())
    for (const MassArray<float>* input : {&exact, &rounded}) {
      const Result r = run(GetParam(), *input, vacuous, kernel);
      const int ulps =
          std::max({worst_ulps(r.c.e, input->e), worst_ulps(r.c.o, input->o), worst_ulps(r.c.u, input->u)});
      if (vacuous_is_neutral(GetParam())) {
        EXPECT_LE(ulps, GetParam() == Rule::dempster && input == &exact ? 0 : 2) << name(kernel);
      } else {
        EXPECT_GT(ulps, 1'000'000) << name(kernel);
      }
      std::cout << "vacuous " << name(GetParam()) << ' ' << name(kernel) << (input == &exact ? " exact" : " rounded")
                << " sums: at most " << ulps << " ulp\n";
      for (float k : r.conflict) ASSERT_EQ(k, 0);
    }
}

TEST_P(CombineProperty, CommutesAndMirrorsWithParadoxicalMassToo) {
  const auto [a, b] = open_pairs<float>(20'000, 12);
  const Result ab = run(GetParam(), a, b, Kernel::automatic);
  expect_same(ab, run(GetParam(), b, a, Kernel::automatic));
  Result mirrored = run(GetParam(), mirror(a), mirror(b), Kernel::automatic);
  std::swap(mirrored.c.e, mirrored.c.o);
  expect_same(ab, mirrored);
  expect_same(ab, run(GetParam(), a, b, Kernel::scalar));
}

// A c of 0 everywhere is no c: the two paths, float and through double, differ by rounding alone.
TEST_P(CombineProperty, NoParadoxicalMassIsTheSameAsNoneGiven) {
  auto [a, b] = pairs();
  const Result plain = run(GetParam(), a, b, Kernel::automatic);
  a.c.assign(a.size(), 0);
  const Result with = run(GetParam(), a, b, Kernel::automatic);
  EXPECT_EQ(plain.total, with.total);
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_NEAR(plain.c.e[i], with.c.e[i], 2.5e-7) << i;
    ASSERT_NEAR(plain.c.u[i], with.c.u[i], 2.5e-7) << i;
    ASSERT_NEAR(plain.c.c[i], with.c.c[i], 2.5e-7) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Rules, CombineProperty,
                         testing::ValuesIn(evigrid::all_rules().begin(), evigrid::all_rules().end()),
                         [](const auto& rule) {
                           std::string word(name(rule.param));
                           std::replace(word.begin(), word.end(), '-', '_');
                           return word;
                         });

using Mass3 = std::array<double, 4>;  // e, o, u, c

Mass3 fuse(Rule rule, const Mass3& a, const Mass3& b) {
  Mass3 c{};
  evigrid::combine(rule, {&a[0], &a[1], &a[2], &a[3]}, {&b[0], &b[1], &b[2], &b[3]}, {&c[0], &c[1], &c[2], &c[3]},
                   static_cast<double*>(nullptr), 1);
  return c;
}
double distance(const Mass3& a, const Mass3& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::fabs(a[i] - b[i]));
  return worst;
}

/// Largest |(a + b) + c − a + (b + c)| over random masses that leave some unknown.
double association_gap(Rule rule) {
  std::mt19937_64 engine(21);
  MassArray<double> m;
  for (int i = 0; i < 30'000; ++i) push_uniform(m, engine);
  double worst = 0;
  for (std::size_t i = 0; i + 2 < m.size(); i += 3) {
    Mass3 s[3];
    for (std::size_t j = 0; j < 3; ++j) s[j] = {m.e[i + j], m.o[i + j], m.u[i + j], 0};
    worst =
        std::max(worst, distance(fuse(rule, fuse(rule, s[0], s[1]), s[2]), fuse(rule, s[0], fuse(rule, s[1], s[2]))));
  }
  return worst;
}

TEST(CombineFacts, WhichRulesAreAssociative) {
  for (const Rule rule :
       {Rule::conjunctive, Rule::dsmc, Rule::dempster, Rule::cautious, Rule::disjunctive, Rule::bayes, Rule::fuzzy})
    EXPECT_LE(association_gap(rule), 1e-12) << name(rule);
  for (const Rule rule : {Rule::yager, Rule::dubois_prade, Rule::dsmh, Rule::pcr1, Rule::pcr2, Rule::pcr3, Rule::pcr4,
                          Rule::pcr5, Rule::pcr6, Rule::germ_pcr2, Rule::murphy})
    EXPECT_GE(association_gap(rule), 0.01) << name(rule);
}

TEST(CombineFacts, CautiousAloneIsIdempotent) {
  std::mt19937_64 engine(22);
  MassArray<double> m;
  for (int i = 0; i < 10'000; ++i) push_uniform(m, engine);
  for (const Rule rule : evigrid::all_rules()) {
    double worst = 0;
    for (std::size_t i = 0; i < m.size(); ++i) {
      const Mass3 a{m.e[i], m.o[i], m.u[i], 0};
      worst = std::max(worst, distance(fuse(rule, a, a), a));
    }
    EXPECT_TRUE(rule == Rule::cautious ? worst <= 1e-15 : worst >= 0.1) << name(rule) << ' ' << worst;
  }
}

TEST(CombineFacts, VacuousIsNeutralForTheProbabilityOfBayesAndTheMembershipsOfFuzzy) {
  std::mt19937_64 engine(23);
  MassArray<double> m;
  for (int i = 0; i < 10'000; ++i) push_uniform(m, engine);
  const Mass3 vacuous{0, 0, 1, 0};
  for (std::size_t i = 0; i < m.size(); ++i) {
    const Mass3 a{m.e[i], m.o[i], m.u[i], 0};
    const double betp = a[1] + a[2] / 2;
    ASSERT_LE(distance(fuse(Rule::bayes, a, vacuous), {1 - betp, betp, 0, 0}), 1e-15);
    ASSERT_LE(distance(fuse(Rule::fuzzy, a, vacuous), {a[0], a[1], (1 - a[0]) * (1 - a[1]), a[0] * a[1]}), 1e-15);
  }
  EXPECT_EQ(fuse(Rule::disjunctive, {.3, .5, .2, 0}, vacuous), vacuous);
}

// Readings of 0.6 for occupied that flip a cell after n opposite ones.
TEST(CombineFacts, ReadingsToFlipACell) {
  const auto readings = [](Rule rule, int agreeing) {
    Mass3 cell{0, 0, 1, 0};
    for (int i = 0; i < agreeing; ++i) cell = fuse(rule, cell, {.6, 0, .4, 0});
    int n = 0;
    for (; cell[1] <= cell[0] + 1e-13 && n < 100; ++n) cell = fuse(rule, cell, {0, .6, .4, 0});
    return n;
  };
  EXPECT_EQ(readings(Rule::yager, 20), 2);
  EXPECT_EQ(readings(Rule::pcr5, 20), 3);
  EXPECT_EQ(readings(Rule::dempster, 20), 21);
}

// Li et al. 2014, Table 1, compares PCR2 with PCR5 on 20 000 random pairs by the signed mean, which hides the spread.
TEST(CombineFacts, Li2014Table1SpreadOfPcr2AgainstPcr5) {
  std::mt19937_64 engine(25);
  constexpr int kPairs = 20'000;
  MassArray<double> m;
  for (int i = 0; i < 2 * kPairs; ++i) push_uniform(m, engine);
  double sum = 0, absolute = 0, largest = 0;
  int decide_otherwise = 0;
  for (std::size_t i = 0; i < m.size(); i += 2) {
    const Mass3 a{m.e[i], m.o[i], m.u[i], 0}, b{m.e[i + 1], m.o[i + 1], m.u[i + 1], 0};
    const Mass3 two = fuse(Rule::pcr2, a, b), five = fuse(Rule::pcr5, a, b);
    sum += two[0] - five[0], absolute += std::fabs(two[0] - five[0]);
    largest = std::max(largest, std::fabs(two[0] - five[0]));
    decide_otherwise += (two[1] > two[0]) != (five[1] > five[0]);
  }
  EXPECT_LE(std::fabs(sum / kPairs), 3e-4);  // no bias: of an absolute mean of 0.006, noise alone
  EXPECT_NEAR(absolute / kPairs, 0.006, 0.0006);
  EXPECT_NEAR(largest, 0.045, 0.004);
  EXPECT_NEAR(1.0 * decide_otherwise / kPairs, 0.011, 0.003);
}

// PCR4 shares a conflict as e : o and falls back to the columns where one is 0: there it jumps.
TEST(CombineFacts, Pcr4JumpsWhereAConjunctiveMassIsZero) {
  const Mass3 a{.6, 0, .4, 0}, b{0, .3, .7, 0};  // no zero: .42 : .12
  EXPECT_GT(fuse(Rule::pcr4, a, b)[0], .55);
  const Mass3 certain{1, 0, 0, 0}, none{.1, .9, 0, 0}, hair{1 - 1e-9, 1e-9, 0, 0};
  EXPECT_NEAR(fuse(Rule::pcr4, certain, none)[0], .595, 1e-12);
  EXPECT_GT(fuse(Rule::pcr4, hair, none)[0], .99);
  EXPECT_LT(distance(fuse(Rule::pcr5, hair, none), fuse(Rule::pcr5, certain, none)), 1e-6);
}

// P_occ = (1 + o − e)/2 is BetP, max(1 − e, o) is Pl.
TEST(CombineFacts, OldReadOutsAreBetPAndPl) {
  std::mt19937_64 engine(26);
  MassArray<double> m;
  for (int i = 0; i < 1000; ++i) push_uniform(m, engine);
  const evigrid::Frame frame({"empty", "occupied"});
  for (std::size_t i = 0; i < m.size(); ++i) {
    const auto belief = evigrid::make_belief(frame, {{"empty", m.e[i]}, {"occupied", m.o[i]}});
    const double betp = evigrid::pignistic(frame, belief, frame.parse("occupied"));
    ASSERT_NEAR((1 + m.o[i] - m.e[i]) / 2, betp, 1e-15);
    ASSERT_NEAR(std::max(1 - m.e[i], m.o[i]), m.o[i] + m.u[i], 4e-16);
  }
}

// At about 110 agreeing readings of 0.6 the unknown leaves the normal floats; `combine` keeps no floor, a map does.
TEST(CombineFacts, UnknownShrinksGeometricallyUnderAllButTheYagerFamily) {
  for (const Rule rule : {Rule::dempster, Rule::pcr1, Rule::pcr2, Rule::pcr4, Rule::pcr5, Rule::conjunctive}) {
    Mass3 cell{0, 0, 1, 0};
    for (int i = 0; i < 100; ++i) cell = fuse(rule, cell, {.6, 0, .4, 0});
    EXPECT_NEAR(std::log(cell[2]) / std::log(.4), 100, 1e-6) << name(rule);
  }
  Mass3 cell{0, 0, 1, 0};
  for (int i = 0; i < 100; ++i) cell = fuse(Rule::yager, cell, i % 2 == 0 ? Mass3{.6, 0, .4, 0} : Mass3{0, .6, .4, 0});
  EXPECT_GT(cell[2], .1);
  EXPECT_GT(std::pow(.4, 95), static_cast<double>(std::numeric_limits<float>::min()));
  EXPECT_LT(std::pow(.4, 113), static_cast<double>(std::numeric_limits<float>::denorm_min()));
}

// Over the orders of five one-sided sources, each empty or occupied with a mass uniform in [0.05, 0.95], sequential
// PCR5 spreads BetP by about 0.11 and changes more than a tenth of the decisions: the order is part of the contract.
TEST(CombineFacts, TheOrderOfReadingsCountsUnderPcr5) {
  std::mt19937_64 engine(24);
  std::uniform_real_distribution<double> unit(0.05, 0.95);
  constexpr int kCells = 4000;
  double sum = 0, most = 0;
  int changed = 0;
  for (int cell = 0; cell < kCells; ++cell) {
    std::array<Mass3, 5> source;
    for (auto& s : source) {
      const double mass = unit(engine);
      s = engine() % 2 == 0 ? Mass3{mass, 0, 1 - mass, 0} : Mass3{0, mass, 1 - mass, 0};
    }
    std::array<int, 5> order{0, 1, 2, 3, 4};
    double low = 1, high = 0;
    do {
      Mass3 m = source[static_cast<std::size_t>(order[0])];
      for (std::size_t i = 1; i < 5; ++i) m = fuse(Rule::pcr5, m, source[static_cast<std::size_t>(order[i])]);
      const double betp = m[1] + m[2] / 2;
      low = std::min(low, betp), high = std::max(high, betp);
    } while (std::next_permutation(order.begin(), order.end()));
    sum += high - low, most = std::max(most, high - low), changed += low < 0.5 && high > 0.5;
  }
  std::cout << "PCR5, orders of five one-sided sources: BetP spreads by " << sum / kCells << ", at most " << most
            << "; " << 100.0 * changed / kCells << " % of decisions change\n";
  EXPECT_NEAR(sum / kCells, 0.11, 0.01);
  EXPECT_GE(most, 0.4);
  EXPECT_GE(1.0 * changed / kCells, 0.1);
}

}  // namespace
