// SPDX-License-Identifier: Apache-2.0
// A source whose m(occupied) is zero by type gives the bits of the same source with a zero in it; and its mirror image
// those of the source with m(empty) = 0. For every rule of maps, on random, certain, vacuous and tiny masses.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#define EVIGRID_LAMBDA
#include "kernels/cell/lane_scalar.hpp"
// After the lane.
#include "kernels/cell/one_sided.hpp"
#include "kernels/cell/rule_dempster.hpp"
#include "kernels/cell/rule_pcr.hpp"
#include "kernels/cell/rule_pcr14.hpp"
#include "kernels/cell/rule_yager.hpp"

namespace evigrid::kernels::scalar {
namespace {

template <class Rule>
class OneSidedRule : public ::testing::Test {};
using Rules = ::testing::Types<Dempster, Yager, Dsmh, Pcr1, Pcr2, Pcr4, Pcr5, GermPcr2>;
TYPED_TEST_SUITE(OneSidedRule, Rules);

bool same(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0 || (a == 0 && b == 0); }

template <class A, class B>
bool same(const A& a, const B& b) {
  bool yes = same(a.cell.a, b.cell.a) && same(a.cell.b, b.cell.b) && same(a.cell.u, b.cell.u) && same(a.k, b.k);
  if constexpr (requires { a.total; }) yes = yes && a.total == b.total;
  return yes;
}

/// The two-sided text that the one-sided rule is made of. Two-sided sources of maps have a shorter one in some rules,
/// which rounds otherwise.
template <class Rule>
auto two_sided(const Cell<float>& cell, const PlainSource<float>& source) {
  if constexpr (requires { Rule::template combine_at_large<MapState>(cell, source); }) {
    return Rule::template combine_at_large<MapState>(cell, source);
  } else {
    return Rule::template combine<MapState>(cell, source);
  }
}

TYPED_TEST(OneSidedRule, SameBitsAsAZeroAndAsTheMirrorImage) {
  std::mt19937 rng(7);
  std::uniform_real_distribution<float> u(0, 1);
  const float special[] = {0, 1, 1e-13f, 1e-12f, 1e-9f, 0.5f};
  int wrong = 0, conflicts = 0;
  for (int i = 0; i < 200000; ++i) {
    const auto pick = [&] { return rng() % 4 == 0 ? special[rng() % 6] : u(rng); };
    const float a = pick(), b = std::min(pick(), 1 - a), x = pick(), v = 1 - x;
    const Cell<float> cell{a, b, std::max(1 - a - b, 1e-30f)}, swapped{b, a, cell.u};
    const auto general = two_sided<TypeParam>(cell, {x, 0.0f, v});
    wrong += same(general, TypeParam::template combine<MapState>(cell, OneSided<float>{x, {}, v})) ? 0 : 1;
    auto mirror = TypeParam::template combine<MapState>(swapped, OneSided<float>{x, {}, v});
    std::swap(mirror.cell.a, mirror.cell.b);
    wrong += same(two_sided<TypeParam>(cell, {0.0f, x, v}), mirror) ? 0 : 1;
    conflicts += general.k > 0 ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(conflicts, 100000);
}

}  // namespace
}  // namespace evigrid::kernels::scalar
