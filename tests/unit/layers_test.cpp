// SPDX-License-Identifier: Apache-2.0
// Read-outs of masses: published values, and the set definitions on random masses.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "evigrid/evigrid.hpp"

namespace evigrid {
namespace {

TEST(Layers, PublishedValues) {
  const Mass m{.4F, 0, .6F};  // Dezert & Smarandache 2008
  EXPECT_NEAR(value_of(Layer::betp, m), .3, 1e-7);
  EXPECT_NEAR(1 - value_of(Layer::dsmp, m), .9985, 5e-5);
  EXPECT_NEAR(value_of(Layer::dsmp, m), .0015, 5e-5);
  const auto fuzzy = [](float e, float o) { return value_of(Layer::fuzzy_map, {e, o, (1 - e) * (1 - o), e * o}); };
  EXPECT_EQ(fuzzy(0, 0), 1);  // chapter 14, eq. 14.18
  EXPECT_EQ(fuzzy(1, 0), 0);
  EXPECT_EQ(fuzzy(0, 1), 1);
  EXPECT_NEAR(fuzzy(.5F, .5F), .929688, 5e-7);
}

/// Sets by bits: 1 empty, 2 occupied; m[0] on nothing.
struct Sets {
  double m[4];
  [[nodiscard]] double bel(int a) const {
    double s = 0;
    for (int b = 1; b < 4; ++b) s += (b & ~a) == 0 ? m[b] : 0;
    return s;
  }
  [[nodiscard]] double pl(int a) const {
    double s = 0;
    for (int b = 1; b < 4; ++b) s += (b & a) != 0 ? m[b] : 0;
    return s;
  }
};

TEST(Layers, FollowTheSetDefinitions) {
  std::mt19937_64 rng(4);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 20000; ++i) {
    double w[4], sum = 0;
    for (double& x : w) x = -std::log(1 - unit(rng)), sum += x;
    if (i % 3 == 0) sum -= w[3], w[3] = 0;
    const Mass m{static_cast<float>(w[0] / sum), static_cast<float>(w[1] / sum), static_cast<float>(w[2] / sum),
                 static_cast<float>(w[3] / sum)};
    Sets open{{m.c, m.e, m.o, m.u}}, s = open;
    const double known = s.m[1] + s.m[2] + s.m[3];
    if (m.c != 0) {
      for (double& x : s.m) x /= known;
    }
    const auto near = [&](Layer layer, double want) { ASSERT_NEAR(value_of(layer, m), want, 1e-12) << name(layer); };
    const auto bits = [](double p) { return p > 0 ? -p * std::log2(p) : 0; };
    const double betp = s.m[2] + s.m[3] / 2, plp = s.pl(2) / (s.pl(1) + s.pl(2));
    near(Layer::bel, open.m[2]);
    near(Layer::empty, open.m[1]);
    near(Layer::unknown, open.m[3]);
    near(Layer::paradox, open.m[0]);
    near(Layer::pl, s.pl(2));
    near(Layer::ignorance, s.pl(2) - s.bel(2));
    near(Layer::commonality, open.m[2] + open.m[3]);
    near(Layer::betp, betp);
    near(Layer::plp, plp);
    near(Layer::free_betp, open.m[2] + open.m[0] + open.m[1] / 2 + open.m[3] * 2 / 3);
    near(Layer::free_both, open.m[0] + (open.m[1] + open.m[2]) / 2 + open.m[3] / 3);
    near(Layer::specificity, s.m[1] + s.m[2] + s.m[3] / 2);
    near(Layer::internal_conflict,
         -s.m[1] * std::log2(s.pl(1)) - s.m[2] * std::log2(s.pl(2)));  // Pl of both is 1
    near(Layer::entropy, bits(betp) + bits(1 - betp));
    const double eps = 1e-3;  // DSmP: m(unknown) in proportion to the masses of the two, and ε each
    near(Layer::dsmp, s.m[2] + s.m[3] * (s.m[2] + eps) / (s.m[1] + s.m[2] + 2 * eps));
    if (m.c == 0) {  // the chapter's other names
      near(Layer::betp,
           (s.m[1] + s.m[2] + s.m[3] + s.m[2] - s.m[1]) / 2);  // (1 + o − e)/2, the 1 as these floats add up
      ASSERT_NEAR(value_of(Layer::pl, m), std::max(1.0 - m.e, static_cast<double>(m.o)), 2e-7);
    }
    const Decision d = decide(m);
    ASSERT_EQ(d == Decision::occupied, m.u < .5F && m.o > m.e);
    ASSERT_EQ(d == Decision::empty, m.u < .5F && m.e > m.o);
    ASSERT_EQ(decide_by_betp(m, .7) == Decision::occupied, betp >= .7);
    ASSERT_EQ(decide_by_betp(m, .7) == Decision::empty, 1 - betp >= .7);
    near(Layer::decision, d == Decision::unknown ? .5 : d == Decision::occupied);
  }
}

TEST(Layers, VacuousAndDegenerateCells) {
  const Mass vacuous;
  for (const Layer l :
       {Layer::betp, Layer::plp, Layer::dsmp, Layer::decision, Layer::decision_betp, Layer::specificity})
    EXPECT_EQ(value_of(l, vacuous), .5) << name(l);
  EXPECT_EQ(value_of(Layer::entropy, vacuous), 1);
  for (const Mass m : {Mass{1, 0, 0}, Mass{0, 1, 0}, Mass{0, 0, 0, 1}, Mass{.5F, .5F, 0}}) {
    for (const Layer l : all_layers()) EXPECT_TRUE(std::isfinite(value_of(l, m))) << name(l);
  }
  EXPECT_EQ(value_of(Layer::dsmp, vacuous, {.dsmp_epsilon = 0}), .5);
  EXPECT_EQ(decide_by_betp({.5F, .5F, 0}, .5), Decision::unknown);
  for (const Layer l : all_layers()) EXPECT_EQ(layer_from_name(name(l)), l);
  EXPECT_FALSE(layer_from_name("nonsense"));
}

}  // namespace
}  // namespace evigrid
