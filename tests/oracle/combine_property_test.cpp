// SPDX-License-Identifier: Apache-2.0
// What every rule of evigrid::combine must keep bit for bit: order of the operands, mirror, kernels, executors,
// aliasing.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <iostream>

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
  Result r{MassArray<float>(a.size()), std::vector<float>(a.size()), 0};
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

TEST_P(CombineProperty, VacuousChangesNothing) {
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
      EXPECT_LE(ulps, GetParam() == Rule::dempster && input == &exact ? 0 : 2) << name(kernel);
      std::cout << "vacuous " << name(GetParam()) << ' ' << name(kernel) << (input == &exact ? " exact" : " rounded")
                << " sums: at most " << ulps << " ulp\n";
      for (float k : r.conflict) ASSERT_EQ(k, 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Rules, CombineProperty,
                         testing::Values(Rule::dempster, Rule::pcr2, Rule::pcr5, Rule::germ_pcr2),
                         [](const auto& rule) {
                           std::string word(name(rule.param));
                           std::replace(word.begin(), word.end(), '-', '_');
                           return word;
                         });

}  // namespace
