// SPDX-License-Identifier: Apache-2.0
// Several sources in one pass: the bits of one call a source, for every rule, kernel, length and place; Murphy's rule
// against its own definition.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "equivalence/mass_arrays.hpp"
#include "evigrid/evigrid.hpp"

namespace evigrid {
namespace {

using testing::Arrays;

struct Answer {
  Arrays m;
  std::vector<float> c, k;
  std::uint64_t totals = 0;
  explicit Answer(std::size_t n) : m(n, 99), c(n), k(n) {}
};

std::vector<Arrays> sources_of(std::size_t s, std::size_t n) {
  std::vector<Arrays> out;
  for (std::size_t i = 0; i < s; ++i) out.emplace_back(n, static_cast<unsigned>(i + 1));
  return out;
}

/// One call a source; a rule that leaves mass on empty ∩ occupied hands it on.
Answer one_by_one(Rule rule, const std::vector<Arrays>& sources, Kernel kernel) {
  const std::size_t n = sources[0].e.size();
  Answer out(n);
  std::vector<float> k(n);
  Planes<const float> state = sources[0].in();
  const bool open = same_as(rule) == Rule::conjunctive || rule == Rule::fuzzy;
  for (std::size_t s = 1; s < sources.size(); ++s) {
    Planes<float> c = out.m.out();
    c.c = open ? out.c.data() : nullptr;
    out.totals += combine(rule, state, sources[s].in(), c, k.data(), n, kernel);
    for (std::size_t i = 0; i < n; ++i) out.k[i] += k[i];
    state = {c.e, c.o, c.u, c.c};
  }
  return out;
}

TEST(Sources, TheBitsOfOneCallASource) {
  for (const Rule rule : all_rules()) {
    for (const std::size_t s : {2, 3, 8}) {
      if (rule == Rule::murphy && s > 2) continue;
      for (const std::size_t n : {1, 1023, 70001}) {
        const std::vector<Arrays> sources = sources_of(s, n);
        std::vector<Planes<const float>> views;
        for (const Arrays& a : sources) views.push_back(a.in());
        for (const Kernel kernel : {Kernel::scalar, Kernel::automatic}) {
          if (kernel == Kernel::scalar && n > 2000 && s > 2) continue;
          const Answer want = one_by_one(rule, sources, kernel);
          Answer got(n);
          Planes<float> c = got.m.out();
          c.c = got.c.data();
          const auto executor = make_spinning_executor(2);
          got.totals = combine(rule, views, c, got.k.data(), n, kernel, executor.get());
          EXPECT_TRUE(got.m == want.m) << name(rule) << " " << s << " " << n << " " << name(kernel);
          EXPECT_EQ(got.c, want.c) << name(rule);
          EXPECT_EQ(got.k, want.k) << name(rule);
          EXPECT_EQ(got.totals, want.totals) << name(rule);
          Arrays first = sources[0];  // in place, keeping neither c nor k
          std::vector<Planes<const float>> again = views;
          again[0] = first.in();
          combine(rule, again, first.out(), nullptr, n, kernel);
          EXPECT_TRUE(first == want.m) << name(rule) << " in place";
        }
      }
    }
  }
}

TEST(Sources, MurphyIsTheirMeanWithItself) {
  const std::size_t n = 1500, s = 5;
  const std::vector<Arrays> sources = sources_of(s, n);
  std::vector<Planes<const float>> views;
  for (const Arrays& a : sources) views.push_back(a.in());
  Arrays got(n, 9);
  combine(Rule::murphy, views, got.out(), nullptr, n);
  for (std::size_t i = 0; i < n; ++i) {
    double e = 0, o = 0, u = 0;
    for (const Arrays& a : sources) e += a.e[i] / 5.0, o += a.o[i] / 5.0, u += a.u[i] / 5.0;
    const double pe = std::pow(e + u, 5), po = std::pow(o + u, 5), pu = std::pow(u, 5);  // commonalities multiply
    const double sum = pe + po - pu;
    ASSERT_NEAR(got.e[i], (pe - pu) / sum, 1e-6);
    ASSERT_NEAR(got.o[i], (po - pu) / sum, 1e-6);
    ASSERT_NEAR(got.u[i], pu / sum, 1e-6);
  }
}

TEST(Sources, DoubleToo) {
  const std::size_t n = 1500;
  std::vector<std::vector<double>> planes(12, std::vector<double>(n));
  std::vector<Planes<const double>> views;
  for (std::size_t s = 0; s < 3; ++s) {
    const Arrays a(n, static_cast<unsigned>(s));
    for (std::size_t i = 0; i < n; ++i)
      planes[3 * s][i] = a.e[i], planes[3 * s + 1][i] = a.o[i], planes[3 * s + 2][i] = a.u[i];
    views.push_back({planes[3 * s].data(), planes[3 * s + 1].data(), planes[3 * s + 2].data()});
  }
  const Planes<double> c{planes[9].data(), planes[10].data(), planes[11].data()};
  for (const Rule rule : {Rule::pcr5, Rule::dempster, Rule::yager}) {
    std::vector<std::vector<double>> want(3, std::vector<double>(n));
    const Planes<double> w{want[0].data(), want[1].data(), want[2].data()};
    combine(rule, views[0], views[1], w, static_cast<double*>(nullptr), n);
    combine(rule, {w.e, w.o, w.u}, views[2], w, static_cast<double*>(nullptr), n);
    combine(rule, std::span<const Planes<const double>>(views), c, nullptr, n);
    for (std::size_t p = 0; p < 3; ++p) EXPECT_EQ(planes[9 + p], want[p]) << name(rule);
  }
}

TEST(Sources, FewerThanTwoAreRefused) {
  Arrays a(10, 1);
  const std::vector<Planes<const float>> one{a.in()};
  EXPECT_THROW(combine(Rule::pcr5, one, a.out(), nullptr, 10), std::invalid_argument);
  EXPECT_THROW(combine(Rule::pcr5, std::span<const Planes<const float>>(), a.out(), nullptr, 10),
               std::invalid_argument);
}

}  // namespace
}  // namespace evigrid
