// SPDX-License-Identifier: Apache-2.0
// Printed results of the rules, as their authors published them, against evigrid::combine (float and double) and
// against the exact oracle that the other tests lean on.
#include <gtest/gtest.h>

#include "tests/oracle/mass_pairs.hpp"

namespace {

using namespace oracle;
using evigrid::Kernel;
using evigrid::Rule;
using Triple = std::array<double, 3>;

constexpr double kNone = -1;  // not printed

struct Printed {
  const char* source;
  Rule rule;
  Triple a, b, result;
  double half_digit;  ///< half a unit of the last printed digit (or what a known misprint needs)
  double paradox = kNone;
};

const std::vector<Printed>& printed() {
  static const char* const dsmt = "Smarandache and Dezert, Advances and Applications of DSmT for Information Fusion";
  static const std::vector<Printed> table{
      {"Smarandache and Dezert (last digit misprinted: .34146)",
       Rule::dempster,
       {.6, 0, .4},
       {0, .3, .7},
       {.512, .146, .342},
       6e-4},
      {dsmt, Rule::pcr5, {.6, 0, .4}, {0, .3, .7}, {.54, .18, .28}, 1e-9},
      {dsmt, Rule::dempster, {.6, .3, .1}, {.2, .3, .5}, {.579, .355, .066}, 5e-4},
      {dsmt, Rule::pcr5, {.6, .3, .1}, {.2, .3, .5}, {.584, .366, .05}, 5e-4},
      {dsmt, Rule::pcr2, {.7, .1, .2}, {.5, .4, .1}, {.752941, .227059, .02}, 5.1e-7},
      // Exactly .7398484848 and .2401515151: the print rounds the last digit up, its pair down.
      {dsmt, Rule::pcr5, {.7, .1, .2}, {.5, .4, .1}, {.739849, .240151, .02}, 5.2e-7},
      {dsmt, Rule::dempster, {.7, .1, .2}, {.5, .4, .1}, {.776119, .194030, .029851}, 5.1e-7},
      {dsmt, Rule::pcr5, {.1, .2, .7}, {.4, .3, .3}, {.4108, .3792, .21}, 5e-5},
      {dsmt, Rule::pcr2, {1, 0, 0}, {.1, .9, 0}, {.595, .405, 0}, 1e-9},
      {dsmt, Rule::pcr5, {1, 0, 0}, {.1, .9, 0}, {.573684, .426316, 0}, 5.1e-7},
      {dsmt, Rule::dempster, {.6, .4, 0}, {.1, .9, 0}, {.142857, .857143, 0}, 5.1e-7},
      {"Hughes and Murphy 1992", Rule::dempster, {.8113, 0, .1887}, {.8012, 0, .1988}, {.9625, 0, .0375}, 5e-5},
      {dsmt, Rule::dempster, {.4, 0, .6}, {0, .6, .4}, {.21, .47, .32}, 5e-3},
      {dsmt, Rule::conjunctive, {.6, 0, .4}, {0, .3, .7}, {.42, .12, .28}, 1e-9, .18},
      {dsmt, Rule::dsmc, {.6, 0, .4}, {0, .3, .7}, {.42, .12, .28}, 1e-9, .18},
      {dsmt, Rule::dsmh, {.6, 0, .4}, {0, .3, .7}, {.42, .12, .46}, 1e-9},
      {dsmt, Rule::yager, {.6, 0, .4}, {0, .3, .7}, {.42, .12, .46}, 1e-9},
      {dsmt, Rule::pcr1, {.6, 0, .4}, {0, .3, .7}, {.474, .147, .379}, 1e-9},
      {dsmt, Rule::pcr4, {.6, 0, .4}, {0, .3, .7}, {.56, .16, .28}, 1e-9},
      {dsmt, Rule::pcr6, {.6, 0, .4}, {0, .3, .7}, {.54, .18, .28}, 1e-9},
      {dsmt, Rule::conjunctive, {.6, .3, .1}, {.2, .3, .5}, {.44, .27, .05}, 1e-9, .24},
      {dsmt, Rule::dsmh, {.6, .3, .1}, {.2, .3, .5}, {.44, .27, .29}, 1e-9},
      {dsmt, Rule::pcr4, {.6, .3, .1}, {.2, .3, .5}, {.5887, .3613, .05}, 5.1e-5},
      {dsmt, Rule::pcr1, {.7, .1, .2}, {.5, .4, .1}, {.7180, .2125, .0695}, 5.1e-5},
      {dsmt, Rule::pcr3, {.7, .1, .2}, {.5, .4, .1}, {.752941, .227059, .02}, 5.1e-7},
      {dsmt, Rule::pcr4, {.7, .1, .2}, {.5, .4, .1}, {.784, .196, .02}, 1e-9},
      {dsmt, Rule::pcr6, {.7, .1, .2}, {.5, .4, .1}, {.739849, .240151, .02}, 5.2e-7},
      {dsmt, Rule::pcr1, {1, 0, 0}, {.1, .9, 0}, {.595, .405, 0}, 1e-9},
      {dsmt, Rule::pcr3, {1, 0, 0}, {.1, .9, 0}, {.595, .405, 0}, 1e-9},
      {dsmt, Rule::pcr4, {1, 0, 0}, {.1, .9, 0}, {.595, .405, 0}, 1e-9},
      {dsmt, Rule::pcr4, {.6, .4, 0}, {.1, .9, 0}, {.142857, .857143, 0}, 5.1e-7},
      {dsmt, Rule::yager, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1e-9},
      {dsmt, Rule::dubois_prade, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1e-9},
      {dsmt, Rule::pcr1, {1, 0, 0}, {0, 1, 0}, {.5, .5, 0}, 1e-9},
      {dsmt, Rule::pcr4, {1, 0, 0}, {0, 1, 0}, {.5, .5, 0}, 1e-9},
      {"BetP of (.4, 0, .6), by bayes with a vacuous source", Rule::bayes, {.4, 0, .6}, {0, 0, 1}, {.7, .3, 0}, 1e-9},
      {dsmt, Rule::pcr2, {1, 0, 0}, {0, 1, 0}, {.5, .5, 0}, 1e-9},
      {dsmt, Rule::pcr5, {1, 0, 0}, {0, 1, 0}, {.5, .5, 0}, 1e-9},
  };
  return table;
}

template <class T>
Triple through_engine(Rule rule, const Triple& a, const Triple& b, Kernel kernel, T* conflict, T* paradox = nullptr) {
  const T x[3] = {T(a[0]), T(a[1]), T(a[2])}, y[3] = {T(b[0]), T(b[1]), T(b[2])};
  T z[3] = {};
  const evigrid::Planes<const T> pa{x, x + 1, x + 2}, pb{y, y + 1, y + 2};
  const evigrid::Planes<T> pc{z, z + 1, z + 2, paradox};
  if constexpr (sizeof(T) == 4) {
    evigrid::combine(rule, pa, pb, pc, conflict, 1, kernel);
  } else {
    evigrid::combine(rule, pa, pb, pc, conflict, 1);
  }
  return {z[0], z[1], z[2]};
}

TEST(PublishedRules, EngineGivesThePrintedValues) {
  for (const Printed& p : printed()) {
    SCOPED_TRACE(testing::Message() << p.source << ", " << name(p.rule));
    for (Kernel kernel : available_kernels()) {
      float k = 0, c = 0;
      const Triple got = through_engine<float>(p.rule, p.a, p.b, kernel, &k, &c);
      if (p.paradox != kNone) {
        EXPECT_NEAR(c, p.paradox, p.half_digit + 2e-7) << name(kernel);
      }
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], p.result[i], p.half_digit + 2e-7) << name(kernel) << ' ' << i;
    }
    double k = 0, c = 0;
    const Triple got = through_engine<double>(p.rule, p.a, p.b, Kernel::scalar, &k, &c);
    if (p.paradox != kNone) {
      EXPECT_NEAR(c, p.paradox, p.half_digit);
    }
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], p.result[i], p.half_digit) << i;
  }
}

TEST(PublishedRules, OracleGivesThePrintedValues) {
  for (const Printed& p : printed()) {
    Belief<double, 3> a{}, b{};
    a[kEmpty] = p.a[0], a[kOccupied] = p.a[1], a[kUnknown] = p.a[2];
    b[kEmpty] = p.b[0], b[kOccupied] = p.b[1], b[kUnknown] = p.b[2];
    const auto r = combine<double, 3>(p.rule, cell_frame(), a, b);
    EXPECT_NEAR(r.m[kEmpty], p.result[0], p.half_digit) << p.source;
    EXPECT_NEAR(r.m[kOccupied], p.result[1], p.half_digit) << p.source;
    EXPECT_NEAR(r.m[kUnknown], p.result[2], p.half_digit) << p.source;
    if (p.paradox != kNone) {
      EXPECT_NEAR(r.m[kBoth], p.paradox, p.half_digit) << p.source;
    }
  }
}

TEST(PublishedRules, ConjunctiveConflictIsThePrintedOne) {
  for (Rule rule : evigrid::all_rules()) {
    double k = 0;
    through_engine<double>(rule, {.6, 0, .4}, {0, .3, .7}, Kernel::scalar, &k);
    EXPECT_NEAR(k, .18, 1e-15) << name(rule);
    through_engine<double>(rule, {.6, .3, .1}, {.2, .3, .5}, Kernel::scalar, &k);
    EXPECT_NEAR(k, .24, 1e-15) << name(rule);
  }
}

// What each rule answers for (1, 0, 0) and (0, 1, 0).
TEST(PublishedRules, CertainContradiction) {
  for (Rule rule : evigrid::all_rules()) {
    std::array<float, 4> want{.5F, .5F, 0, 0};  // the PCR family, cautious, murphy
    bool counted = false;
    switch (rule) {
      case Rule::dempster:
      case Rule::dempster_log:
        counted = true;
        [[fallthrough]];
      case Rule::yager:
      case Rule::dubois_prade:
      case Rule::dsmh:
      case Rule::disjunctive:
        want = {0, 0, 1, 0};
        break;
      case Rule::conjunctive:
      case Rule::dsmc:
        want = {0, 0, 0, 1};
        break;
      case Rule::fuzzy:
        want = {1, 1, 0, 1};
        break;
      case Rule::bayes:
        counted = true;
        break;
      default:
        break;
    }
    for (Kernel kernel : available_kernels()) {
      MassArray<float> a, b, c(3, true);
      for (int i = 0; i < 3; ++i) a.push(1, 0, 0), b.push(i == 1 ? 1.0F : 0.0F, i == 1 ? 0.0F : 1.0F, 0);
      std::vector<float> k(3);
      EXPECT_EQ(evigrid::combine(rule, a.view(), b.view(), c.planes(), k.data(), 3, kernel), counted ? 2U : 0U)
          << name(rule);
      EXPECT_EQ(k, (std::vector<float>{1, 0, 1}));
      EXPECT_EQ(c.e, (std::vector<float>{want[0], 1, want[0]})) << name(rule);
      EXPECT_EQ(c.o, (std::vector<float>{want[1], 0, want[1]})) << name(rule);
      EXPECT_EQ(c.u, (std::vector<float>{want[2], 0, want[2]})) << name(rule);
      EXPECT_EQ(c.c, (std::vector<float>{want[3], 0, want[3]})) << name(rule);
    }
  }
}

// The oracle is generic over the frame: Zadeh's example has three hypotheses, each one Venn part.
TEST(PublishedRules, OracleGivesZadehsExample) {
  const Frame frame{{1, 2, 4}, 0};
  Belief<mpq_class, 3> a, b;
  a[1] = mpq_class(9, 10), a[4] = mpq_class(1, 10), b[2] = mpq_class(9, 10), b[4] = mpq_class(1, 10);
  const auto dempster = combine<mpq_class, 3>(Rule::dempster, frame, a, b);
  EXPECT_EQ(dempster.conflict, mpq_class(99, 100));
  EXPECT_EQ(dempster.m[4], 1);
  const auto pcr5 = combine<mpq_class, 3>(Rule::pcr5, frame, a, b);
  EXPECT_NEAR(pcr5.m[1].get_d(), .486, 1e-12);
  EXPECT_NEAR(pcr5.m[2].get_d(), .486, 1e-12);
  EXPECT_NEAR(pcr5.m[4].get_d(), .028, 1e-12);
  const auto yager = combine<mpq_class, 3>(Rule::yager, frame, a, b);
  EXPECT_EQ(yager.m[4], mpq_class(1, 100));
  EXPECT_EQ(yager.m[7], mpq_class(99, 100));
  const auto union_rule = combine<mpq_class, 3>(Rule::dubois_prade, frame, a, b);
  EXPECT_EQ(union_rule.m[1 | 2], mpq_class(81, 100));
  EXPECT_EQ(union_rule.m[4], mpq_class(1, 100));
  EXPECT_EQ(union_rule.m[1 | 4], mpq_class(9, 100));
  EXPECT_EQ(union_rule.m[2 | 4], mpq_class(9, 100));
}

// GERM-PCR2 by its own definition: the paradoxical mass joins the conflict, and goes to ignorance without a column.
TEST(PublishedRules, OracleTakesTheParadoxicalMassIntoTheConflict) {
  Belief<mpq_class, 3> cell, source;
  cell[kEmpty] = mpq_class(3, 10), cell[kOccupied] = mpq_class(2, 10), cell[kUnknown] = mpq_class(1, 2);
  source[kOccupied] = mpq_class(6, 10), source[kBoth] = mpq_class(1, 10), source[kUnknown] = mpq_class(3, 10);
  const auto r = combine<mpq_class, 3>(Rule::germ_pcr2, cell_frame(), cell, source);
  EXPECT_EQ(r.conflict, mpq_class(7, 25));  // z + k = .1 + .3 * .6
  EXPECT_EQ(r.m[kUnknown], mpq_class(3, 20));
  EXPECT_EQ(r.m[kEmpty], mpq_class(9, 100) + mpq_class(7, 25) * mpq_class(3, 11));
  Belief<mpq_class, 3> vacuous, both;
  vacuous[kUnknown] = 1, both[kBoth] = mpq_class(1, 4), both[kUnknown] = mpq_class(3, 4);
  EXPECT_EQ((combine<mpq_class, 3>(Rule::germ_pcr2, cell_frame(), vacuous, both).m[kUnknown]), 1);
}

}  // namespace
