// SPDX-License-Identifier: Apache-2.0
// The batch call: in place equals out of place, every table equals scalar bit for bit, any length and executor, and the
// fused map's rule on exact operands is the same rule.
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#include "evigrid/evigrid.hpp"
#include "sanitizer.hpp"

namespace evigrid {
namespace {

struct Arrays {
  std::vector<float> e, o, u;
  explicit Arrays(std::size_t n, unsigned seed) : e(n), o(n), u(n) {
    std::mt19937 rng(seed);
    std::uniform_real_distribution<float> r(0, 1);
    for (std::size_t i = 0; i < n; ++i) {
      e[i] = i % 5 == 0 ? static_cast<float>(i / 5 % 2) : r(rng);
      o[i] = i % 5 == 0 ? 1 - e[i] : r(rng) * (1 - e[i]);
      u[i] = 1 - e[i] - o[i];
    }
  }
  Planes<const float> in() const { return {e.data(), o.data(), u.data()}; }
  Planes<float> out() { return {e.data(), o.data(), u.data()}; }
  bool operator==(const Arrays& b) const {
    return e.empty() || (std::memcmp(e.data(), b.e.data(), e.size() * 4) == 0 &&
                         std::memcmp(o.data(), b.o.data(), o.size() * 4) == 0 &&
                         std::memcmp(u.data(), b.u.data(), u.size() * 4) == 0);
  }
};

TEST(Dense, SameBitsForTablesLengthsAndPlace) {
  for (const Rule rule : all_rules()) {
    for (const std::size_t n : {0, 1, 15, 63, 64, 65, 1000, 200001}) {
      const Arrays a(n, 1), b(n, 2);
      Arrays want(n, 3);
      std::vector<float> k(n), k2(n);
      const auto totals = combine(rule, a.in(), b.in(), want.out(), k.data(), n, Kernel::scalar);
      for (const Kernel kernel : {Kernel::avx2, Kernel::avx512}) {
        if (!kernel_available(kernel)) continue;
        Arrays got = a;
        const auto executor = testing::kThreadSanitizer ? make_serial_executor() : make_tbb_executor(2);
        EXPECT_EQ(combine(rule, got.in(), b.in(), got.out(), k2.data(), n, kernel, executor.get()), totals);
        EXPECT_TRUE(got == want) << name(rule) << " " << name(kernel) << " " << n;
        EXPECT_EQ(k, k2);
      }
    }
  }
}

}  // namespace
}  // namespace evigrid
