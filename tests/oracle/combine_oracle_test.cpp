// SPDX-License-Identifier: Apache-2.0
// evigrid::combine against exact rational arithmetic, for every rule, every kernel of this processor and double.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/exhaustive.hpp"
#include "tests/oracle/mass_pairs.hpp"

namespace {

using namespace oracle;
using evigrid::Kernel;
using evigrid::Rule;

// Exact arithmetic takes a minute for a hundred thousand pairs: a quarter of them, unless asked for all.
const std::size_t kShare = evigrid::tests::exhaustive() ? 1 : 4;
const std::size_t kRandomPairs = 100'000 / kShare, kOpenPairs = 30'000 / kShare;
constexpr std::size_t kReadings = 100'000;
constexpr long double kFloatBound = 2e-7L, kDoubleBound = 2e-15L;

struct Worst {
  long double mass = 0, conflict = 0;
  std::size_t at = 0;
};

template <class T>
Worst worst_error(const Exact& exact, const MassArray<T>& c, const std::vector<T>& conflict) {
  Worst worst;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const auto& want = exact.eouck[i];
    const long double mass = std::max({std::fabs(c.e[i] - want[0]), std::fabs(c.o[i] - want[1]),
                                       std::fabs(c.u[i] - want[2]), std::fabs(c.c[i] - want[3])});
    const bool broken =
        !std::isfinite(c.e[i]) || !std::isfinite(c.o[i]) || !std::isfinite(c.u[i]) || !std::isfinite(c.c[i]);
    if (broken || mass > worst.mass) worst.mass = broken ? INFINITY : mass, worst.at = i;
    worst.conflict = std::max(worst.conflict, std::fabs(conflict[i] - want[4]));
    if (broken) break;
  }
  return worst;
}

std::uint64_t run(Rule rule, const Pairs<float>& p, MassArray<float>& c, std::vector<float>& k, Kernel kernel) {
  return evigrid::combine(rule, p.a.view(), p.b.view(), c.planes(), k.data(), p.size(), kernel);
}
std::uint64_t run(Rule rule, const Pairs<double>& p, MassArray<double>& c, std::vector<double>& k, Kernel) {
  return evigrid::combine(rule, p.a.view(), p.b.view(), c.planes(), k.data(), p.size());
}

template <class T>
void expect_exact(const Pairs<T>& pairs, const std::vector<Kernel>& kernels, long double bound, const char* what) {
  for (Rule rule : evigrid::all_rules()) {
    const Exact exact = exact_results(rule, pairs);
    for (Kernel kernel : kernels) {
      MassArray<T> c(pairs.size(), true);
      std::vector<T> conflict(pairs.size());
      const std::uint64_t total = run(rule, pairs, c, conflict, kernel);
      const Worst worst = worst_error(exact, c, conflict);
      const std::size_t i = worst.at;
      SCOPED_TRACE(testing::Message() << what << ' ' << name(rule) << ' ' << name(kernel) << " pair " << i << ": ("
                                      << pairs.a.e[i] << ' ' << pairs.a.o[i] << ' ' << pairs.a.u[i] << ") + ("
                                      << pairs.b.e[i] << ' ' << pairs.b.o[i] << ' ' << pairs.b.u[i] << ") = (" << c.e[i]
                                      << ' ' << c.o[i] << ' ' << c.u[i] << ')');
      EXPECT_LE(worst.mass, bound);
      EXPECT_LE(worst.conflict, bound);
      EXPECT_EQ(total, exact.total_conflicts);
      const std::string key = std::string(what) + "_" + std::string(name(rule)) + "_" + std::string(name(kernel));
      std::cout << "largest error " << key << ": masses " << static_cast<double>(worst.mass) << ", conflict "
                << static_cast<double>(worst.conflict) << '\n';
      testing::Test::RecordProperty(key, std::to_string(static_cast<double>(worst.mass) * 1e9) + "e-9");
    }
  }
}

TEST(CombineOracle, FloatAgreesWithExactArithmeticOnRandomPairs) {
  expect_exact(random_pairs<float>(kRandomPairs, 1), available_kernels(), kFloatBound, "float_random");
}

TEST(CombineOracle, FloatAgreesWithExactArithmeticOnCornerCases) {
  expect_exact(corner_pairs<float>(), available_kernels(), kFloatBound, "float_corners");
}

TEST(CombineOracle, DoubleAgreesWithExactArithmeticOnRandomPairs) {
  expect_exact(random_pairs<double>(kRandomPairs, 2), {Kernel::scalar}, kDoubleBound, "double_random");
}

TEST(CombineOracle, DoubleAgreesWithExactArithmeticOnCornerCases) {
  expect_exact(corner_pairs<double>(), {Kernel::scalar}, kDoubleBound, "double_corners");
}

TEST(CombineOracle, FloatWithParadoxicalMassAgreesWithExactArithmetic) {
  expect_exact(open_pairs<float>(kOpenPairs, 3), {Kernel::scalar, Kernel::automatic}, kFloatBound, "float_open");
}

TEST(CombineOracle, DoubleWithParadoxicalMassAgreesWithExactArithmetic) {
  expect_exact(open_pairs<double>(kOpenPairs, 4), {Kernel::scalar}, kDoubleBound, "double_open");
}

TEST(CombineOracle, RandomPairsHoldAFifthOfZerosAndCertainContradictions) {
  const auto pairs = random_pairs<float>(kRandomPairs, 1);
  std::size_t with_zero = 0, contradictions = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& [a, b] = pairs;
    with_zero += a.e[i] * a.o[i] * a.u[i] * b.e[i] * b.o[i] * b.u[i] == 0;
    contradictions += (a.e[i] == 1 && b.o[i] == 1) || (a.o[i] == 1 && b.e[i] == 1);
    const double sum = static_cast<double>(a.e[i]) + a.o[i] + a.u[i];
    ASSERT_NEAR(sum, 1, 1.2e-7);
  }
  EXPECT_GE(with_zero, kRandomPairs / 6);
  EXPECT_GE(contradictions, kRandomPairs / 20);
}

// The state of a cell under a long run of readings: nothing but the division by its own sum keeps it normalised.
TEST(CombineOracle, SumsStayNearOneOverHundredThousandSequentialUpdates) {
  std::vector<MassArray<float>> runs(4);
  std::mt19937_64 engine(7);
  for (std::size_t i = 0; i < kReadings; ++i) {
    push_uniform(runs[0], engine);
    push_special(runs[1], engine);
    push_normalised(runs[2], 0.6F, 0.0F);
    push_normalised(runs[3], i % 2 == 0 ? 0.9F : 0.0F, i % 2 == 0 ? 0.0F : 0.9F);
  }
  MassArray<float> sources(0);  // the four readings of one time side by side
  for (std::size_t i = 0; i < kReadings; ++i)
    for (const auto& r : runs) sources.push(r.e[i], r.o[i], r.u[i]);
  for (Rule rule : evigrid::map_rules()) {
    if (evigrid::keeps_paradox(rule)) continue;  // what it leaves is no sum of e, o, u
    for (Kernel kernel : available_kernels()) {
      MassArray<float> cells(0);
      for (std::size_t r = 0; r < runs.size(); ++r) cells.push(0, 0, 1);
      std::array<double, 4> worst{};
      for (std::size_t i = 0; i < kReadings; ++i) {
        const std::size_t at = i * runs.size();
        const evigrid::Planes<const float> source{&sources.e[at], &sources.o[at], &sources.u[at]};
        evigrid::combine(rule, cells.view(), source, cells.planes(), static_cast<float*>(nullptr), runs.size(), kernel);
        for (std::size_t r = 0; r < runs.size(); ++r) {
          const double off = std::fabs(static_cast<double>(cells.e[r]) + cells.o[r] + cells.u[r] - 1);
          worst[r] = std::isfinite(off) ? std::max(worst[r], off) : INFINITY;
        }
      }
      for (std::size_t r = 0; r < runs.size(); ++r)
        EXPECT_LE(worst[r], 4e-7) << name(rule) << ' ' << name(kernel) << " run " << r;
      std::cout << "largest |sum - 1| " << name(rule) << ' ' << name(kernel) << ": "
                << *std::max_element(worst.begin(), worst.end()) << '\n';
    }
  }
}

}  // namespace
