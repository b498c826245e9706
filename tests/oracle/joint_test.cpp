// SPDX-License-Identifier: Apache-2.0
// Several sources at once: combine_joint against exact rationals from the definitions, printed values, and the facts
// that the joint forms are known for; the deferred states against the joint forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "evigrid/joint.hpp"
#include "tests/oracle/joint_definitions.hpp"
#include "tests/oracle/mass_pairs.hpp"

namespace {

using namespace oracle;
using evigrid::Planes;
using evigrid::Rule;
using Triple = std::array<double, 3>;

const std::vector<Rule>& joint_rules() {
  static const std::vector<Rule> rules = [] {
    std::vector<Rule> out;
    for (Rule r : evigrid::all_rules())
      if (evigrid::has_joint_form(r)) out.push_back(r);
    return out;
  }();
  return rules;
}

template <class T>
std::vector<MassArray<T>> random_sources(std::size_t sources, std::size_t n, unsigned seed, bool open) {
  std::vector<MassArray<T>> out;
  for (std::size_t s = 0; s < sources; s += 2) {
    const unsigned at = seed + 10 * static_cast<unsigned>(s);
    Pairs<T> pair = open ? open_pairs<T>(n, at) : random_pairs<T>(n, at);
    out.push_back(std::move(pair.a));
    if (s + 1 < sources) out.push_back(std::move(pair.b));
  }
  return out;
}

template <class T>
struct Joint {
  MassArray<T> c;
  std::vector<T> k;
};
template <class T>
Joint<T> run(Rule rule, const std::vector<MassArray<T>>& sources, evigrid::Executor* executor = nullptr) {
  std::vector<Planes<const T>> views;
  for (const auto& s : sources) views.push_back(s.view());
  Joint<T> out{MassArray<T>(sources[0].size(), true), std::vector<T>(sources[0].size())};
  evigrid::combine_joint(rule, views, out.c.planes(), out.k.data(), out.k.size(), executor);
  return out;
}

template <class T>
void expect_exact(std::size_t sources, std::size_t n, unsigned seed, bool open, long double bound) {
  const auto m = random_sources<T>(sources, n, seed, open);
  for (Rule rule : joint_rules()) {
    const Joint<T> got = run(rule, m);
    long double worst = 0;
    for (std::size_t i = 0; i < n; ++i) {
      std::vector<Belief<mpq_class, 3>> exact;
      for (const auto& s : m) {
        Belief<mpq_class, 3> b;
        b[kEmpty] = static_cast<double>(s.e[i]), b[kOccupied] = static_cast<double>(s.o[i]);
        b[kUnknown] = static_cast<double>(s.u[i]), b[kBoth] = s.c.empty() ? 0.0 : static_cast<double>(s.c[i]);
        exact.push_back(b);
      }
      const auto want = combine_joint<mpq_class, 3>(rule, cell_frame(), exact);
      const long double error = std::max({std::fabs(got.c.e[i] - to_long_double(want.m[kEmpty])),
                                          std::fabs(got.c.o[i] - to_long_double(want.m[kOccupied])),
                                          std::fabs(got.c.u[i] - to_long_double(want.m[kUnknown])),
                                          std::fabs(got.k[i] - to_long_double(want.conflict)),
                                          std::fabs(static_cast<long double>(got.c.c[i]))});
      worst = std::isfinite(error) ? std::max(worst, error) : INFINITY;
    }
    EXPECT_LE(worst, bound) << name(rule) << ", " << sources << " sources";
    std::cout << "largest error " << name(rule) << ", " << sources << " sources: " << static_cast<double>(worst)
              << '\n';
  }
}

TEST(JointOracle, DoubleAgreesWithExactArithmetic) {
  expect_exact<double>(2, 1000, 1, false, 2e-15L);
  expect_exact<double>(3, 500, 2, false, 2e-15L);
  expect_exact<double>(5, 40, 3, false, 2e-15L);
  expect_exact<double>(8, 2, 4, false, 2e-15L);
}
TEST(JointOracle, DoubleWithParadoxicalMassAgreesWithExactArithmetic) {
  expect_exact<double>(2, 400, 5, true, 2e-15L);
  expect_exact<double>(4, 60, 6, true, 2e-15L);
}
TEST(JointOracle, FloatAgreesWithExactArithmetic) {
  expect_exact<float>(3, 400, 7, false, 2e-7L);
  expect_exact<float>(4, 60, 8, true, 2e-7L);
}

Triple three(Rule rule, std::vector<Triple> sources, double* k = nullptr) {
  std::vector<MassArray<double>> m;
  for (const Triple& t : sources) {
    MassArray<double> one;
    one.push(t[0], t[1], t[2]);
    m.push_back(std::move(one));
  }
  const Joint<double> r = run(rule, m);
  if (k != nullptr) *k = r.k[0];
  return {r.c.e[0], r.c.o[0], r.c.u[0]};
}

void expect_near(const Triple& got, const Triple& want, double tolerance, const char* what) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(got[i], want[i], tolerance) << what << ' ' << i;
}

// Dezert, Dezert & Smarandache 2021, three sources jointly, then with a vacuous fourth.
TEST(JointPublished, DezertDezertSmarandache2021ThreeSources) {
  const std::vector<Triple> m{{.6, .1, .3}, {.5, .3, .2}, {.4, .1, .5}};
  double k = 0;
  expect_near(three(Rule::pcr5, m, &k), {.723281, .182460, .094259}, 5.1e-7, "pcr5");
  EXPECT_NEAR(k, .343, 1e-12);
  expect_near(three(Rule::pcr6, m), {.743496, .162245, .094259}, 5.1e-7, "pcr6");
  expect_near(three(Rule::pcr5plus, m), {.768631, .201369, .03}, 5.1e-7, "pcr5plus");
  expect_near(three(Rule::pcr6plus, m), {.788847, .181153, .03}, 5.1e-7, "pcr6plus");
  auto four = m;
  four.push_back({0, 0, 1});
  expect_near(three(Rule::pcr5, four), {.654604, .144825, .200571}, 5.1e-7, "pcr5 and a vacuous source");
  expect_near(three(Rule::pcr6, four), {.647113, .128342, .224545}, 5.1e-7, "pcr6 and a vacuous source");
  expect_near(three(Rule::pcr5plus, four), {.768631, .201369, .03}, 5.1e-7, "pcr5plus and a vacuous source");
  expect_near(three(Rule::pcr6plus, four), {.788847, .181153, .03}, 5.1e-7, "pcr6plus and a vacuous source");
}

// The conjunctive part of the same three sources: one after the other, the rule being associative.
TEST(JointPublished, DezertDezertSmarandache2021ConjunctiveOfThreeSources) {
  std::array<std::array<double, 4>, 3> m{{{.6, .1, .3}, {.5, .3, .2}, {.4, .1, .5}}};
  std::vector<Planes<const double>> sources;
  for (const auto& s : m) sources.push_back({&s[0], &s[1], &s[2], nullptr});
  std::array<double, 4> c{};
  for (Rule rule : {Rule::conjunctive, Rule::dsmc}) {
    evigrid::combine(rule, sources[0], sources[1], Planes<double>{&c[0], &c[1], &c[2], &c[3]},
                     static_cast<double*>(nullptr), 1);
    const std::array<double, 4> two = c;
    evigrid::combine(rule, Planes<const double>{&two[0], &two[1], &two[2], &two[3]}, sources[2],
                     Planes<double>{&c[0], &c[1], &c[2], &c[3]}, static_cast<double*>(nullptr), 1);
    expect_near({c[0], c[1], c[2]}, {.537, .09, .03}, 1e-12, "conjunctive");
    EXPECT_NEAR(c[3], .343, 1e-12) << name(rule);
  }
}

TEST(JointFacts, VacuousSourceIsNeutralForAllButPcr1Pcr5Pcr6) {
  const auto m = random_sources<double>(3, 500, 21, false);
  auto more = m;
  MassArray<double> vacuous;
  for (std::size_t i = 0; i < 500; ++i) vacuous.push(0, 0, 1);
  more.insert(more.begin() + 1, vacuous);
  for (Rule rule : joint_rules()) {
    const auto a = run(rule, m), b = run(rule, more);
    double worst = 0;
    for (std::size_t i = 0; i < 500; ++i)
      worst = std::max({worst, std::fabs(a.c.e[i] - b.c.e[i]), std::fabs(a.c.o[i] - b.c.o[i])});
    const bool neutral = rule != Rule::pcr1 && rule != Rule::pcr5 && rule != Rule::pcr6;
    EXPECT_EQ(worst <= 4e-15, neutral) << name(rule) << ' ' << worst;
  }
}

TEST(JointFacts, OrderOfSourcesDoesNotCount) {
  auto m = random_sources<double>(4, 300, 31, true);
  for (Rule rule : joint_rules()) {
    const auto a = run(rule, m);
    std::rotate(m.begin(), m.begin() + 1, m.end());
    const auto b = run(rule, m);
    for (std::size_t i = 0; i < 300; ++i) EXPECT_NEAR(a.c.e[i], b.c.e[i], 2e-15) << name(rule);
  }
}

TEST(JointFacts, SameBitsForEveryExecutor) {
  const auto m = random_sources<float>(3, 2000, 41, false);
  for (Rule rule : joint_rules()) {
    const auto serial = run(rule, m);
    for (const char* kind : {"serial", "tbb", "openmp"}) {
      const auto executor = evigrid::make_executor(kind, 2);
      EXPECT_EQ(run(rule, m, executor.get()).c, serial.c) << name(rule) << ' ' << kind;
    }
  }
}

TEST(JointFacts, RefusesWhatHasNoJointForm) {
  MassArray<double> one, out(1);
  one.push(.5, .2, .3);
  std::vector<Planes<const double>> nine(9, one.view());
  EXPECT_THROW(evigrid::combine_joint(Rule::germ_pcr2, std::span(nine).first(2), out.planes(), nullptr, 1),
               std::invalid_argument);
  EXPECT_THROW(evigrid::combine_joint(Rule::pcr5, nine, out.planes(), nullptr, 1), std::invalid_argument);
  EXPECT_THROW(evigrid::combine_joint(Rule::pcr5, std::span(nine).first(0), out.planes(), nullptr, 1),
               std::invalid_argument);
}

TEST(Deferred, ReadsTheJointFormOfAllThatWasAdded) {
  constexpr std::size_t kCells = 400;
  const auto m = random_sources<double>(6, kCells, 51, false);
  evigrid::DeferredCells cells(kCells);
  for (std::size_t s = 0; s < m.size(); ++s) {
    const std::vector<MassArray<double>> so_far(m.begin(), m.begin() + static_cast<std::ptrdiff_t>(s) + 1);
    for (std::size_t i = 0; i < kCells; ++i) cells.add(i, m[s].e[i], m[s].o[i], m[s].u[i]);
    for (Rule rule : {Rule::yager, Rule::dubois_prade, Rule::pcr1, Rule::pcr2, Rule::pcr3}) {
      const auto want = run(rule, so_far);
      for (std::size_t i = 0; i < kCells; ++i) {
        const auto got = cells.read(rule, i);
        ASSERT_NEAR(got.e, want.c.e[i], 2e-15) << name(rule);
        ASSERT_NEAR(got.o, want.c.o[i], 2e-15);
        ASSERT_NEAR(got.u, want.c.u[i], 2e-15);
        ASSERT_NEAR(got.k, want.k[i], 2e-15);
      }
    }
  }
  cells.clear(3);
  EXPECT_EQ(cells.read(Rule::pcr2, 3).u, 1);
  EXPECT_THROW((void)cells.read(Rule::pcr5, 0), std::invalid_argument);
}

// Over a long buffer nothing is left of the conjunctive part: PCR1 is then the mean of the readings.
TEST(Deferred, LongBuffersTendToTheAverage) {
  evigrid::DeferredCells cells(1);
  std::mt19937_64 engine(3);
  MassArray<double> all;
  for (int i = 0; i < 2000; ++i) push_uniform(all, engine);
  double e = 0;
  for (std::size_t i = 0; i < all.size(); ++i) cells.add(0, all.e[i], all.o[i], all.u[i]), e += all.e[i] / 2000;
  EXPECT_NEAR(cells.read(Rule::pcr1, 0).e, e, 1e-12);
}

TEST(Window, CombinesTheLastFiveInOrder) {
  std::mt19937_64 engine(5);
  MassArray<float> all;
  for (int i = 0; i < 8; ++i) push_uniform(all, engine);
  evigrid::WindowCells cells(3);  // cell 1 gets eight readings, cell 2 two, cell 0 none
  for (std::size_t i = 0; i < 8; ++i) cells.add(1, {all.e[i], all.o[i], all.u[i]});
  for (std::size_t i = 0; i < 2; ++i) cells.add(2, {all.e[i], all.o[i], all.u[i]});
  EXPECT_EQ(cells.count(0), 0);
  EXPECT_EQ(cells.count(1), 5);
  EXPECT_EQ(cells.count(2), 2);
  MassArray<float> got(3), want(1);
  cells.read(Rule::pcr5, got.planes());
  EXPECT_EQ(got.u[0], 1);
  const auto in_order = [&](std::size_t first, std::size_t last) {
    want.e[0] = want.o[0] = 0, want.u[0] = 1;
    for (std::size_t i = first; i < last; ++i)
      evigrid::combine(Rule::pcr5, want.view(), {&all.e[i], &all.o[i], &all.u[i], nullptr}, want.planes(),
                       static_cast<float*>(nullptr), 1);
  };
  in_order(3, 8);
  EXPECT_EQ(got.e[1], want.e[0]);
  EXPECT_EQ(got.o[1], want.o[0]);
  in_order(0, 2);
  EXPECT_EQ(got.e[2], want.e[0]);
  cells.clear(1);
  EXPECT_EQ(cells.count(1), 0);
  EXPECT_THROW(evigrid::WindowCells(1, 0), std::invalid_argument);
}

}  // namespace
