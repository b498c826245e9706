// SPDX-License-Identifier: Apache-2.0
// The batch call: in place equals out of place, every table equals scalar bit for bit, any length and executor, and the
// fused map's rule on exact operands is the same rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "equivalence/mass_arrays.hpp"
#include "evigrid/evigrid.hpp"
#include "sanitizer.hpp"

namespace evigrid {
namespace {

using testing::Arrays;

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

/// Arrays need not begin on a cache line, nor the planes at the same place of one.
TEST(Dense, SameBitsWhereverArraysBegin) {
  const std::size_t n = 3000;
  const Arrays a(n + 40, 1), b(n + 40, 2);
  Arrays want(n, 3);
  const auto at = [](const Arrays& x, std::size_t e, std::size_t o, std::size_t u) {
    return Planes<const float>{x.e.data() + e, x.o.data() + o, x.u.data() + u};
  };
  for (const auto& [e, o, u] : {std::tuple(1u, 1u, 1u), std::tuple(4u, 4u, 4u), std::tuple(15u, 2u, 31u)}) {
    const auto totals = combine(Rule::dempster, at(a, e, o, u), at(b, u, o, e), want.out(), nullptr, n, Kernel::scalar);
    for (const Kernel kernel : {Kernel::avx2, Kernel::avx512}) {
      if (!kernel_available(kernel)) continue;
      Arrays got = a;  // in place, at the same offsets
      const Planes<float> c{got.e.data() + e, got.o.data() + o, got.u.data() + u};
      EXPECT_EQ(combine(Rule::dempster, {c.e, c.o, c.u}, at(b, u, o, e), c, nullptr, n, kernel), totals);
      EXPECT_TRUE(std::equal(want.e.begin(), want.e.end(), c.e) && std::equal(want.o.begin(), want.o.end(), c.o) &&
                  std::equal(want.u.begin(), want.u.end(), c.u))
          << name(kernel) << " " << e << " " << o << " " << u;
      EXPECT_EQ(got.e[n + e], a.e[n + e]);  // nothing beyond
    }
  }
}

}  // namespace
}  // namespace evigrid
