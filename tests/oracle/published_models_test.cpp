// SPDX-License-Identifier: Apache-2.0
// Printed values of the sensor models against evigrid::evaluate, and composition of poses against long double.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "evigrid/evigrid.hpp"
#include "tests/oracle/reference_model.hpp"

namespace {

using evigrid::Model;
using evigrid::Pose2;
using evigrid::Sensor;

constexpr double kDegree = std::numbers::pi / 180;

// Murphy, Introduction to AI Robotics: Rmax 10, tolerance 0.5, beta 15 degrees.
TEST(PublishedModels, Hughes1992AsInTheBook) {
  Sensor s;
  s.model = Model::hughes1992;
  s.aperture_rad = 30 * kDegree;
  s.max_range_m = 10;
  s.hughes = {.r_max_m = 10, .max_occupied = 0.98, .tolerance_m = 0.5};
  const auto near = evaluate(s, 6, 3.5, 0);
  EXPECT_NEAR(near.e, 0.825, 1e-6);
  EXPECT_EQ(near.o, 0);
  EXPECT_NEAR(near.u, 0.175, 1e-6);
  const auto beside = evaluate(s, 6, 6, 5 * kDegree);
  EXPECT_NEAR(beside.o, 0.5227, 5e-5);
  EXPECT_EQ(beside.e, 0);
  EXPECT_NEAR(evaluate(s, 6, 6, -5 * kDegree).o, beside.o, 1e-6);
  EXPECT_NEAR(evaluate(s, 9, 9, 0).o, 0.539, 1e-6);
  EXPECT_NEAR(evaluate(s, 9, 9, 0).u, 0.461, 1e-6);
}

// Hughes & Murphy 1992, point A: r = 205 cm at 8.74° and 211 cm at −8.66°, printed .8113 and .8012. Their formula with
// their constants gives .5742 and .5729; only the combination, .9625, agrees with the readings
// (published_rules_test.cpp).
TEST(PublishedModels, Hughes1992PointAByTheFormula) {
  Sensor s;
  s.model = Model::hughes1992;
  s.aperture_rad = 30 * kDegree;
  s.max_range_m = 7.62;
  EXPECT_NEAR(evaluate(s, 4, 2.05, 8.74 * kDegree).e, .5742, 5.1e-5);
  EXPECT_NEAR(evaluate(s, 4, 2.11, -8.66 * kDegree).e, .5729, 5.1e-5);
}

// Li, Huang, Wang, Dezert 2014, Table 3: on the axis, R and d in mm.
TEST(PublishedModels, Li2014Table3) {
  struct Row {
    double range_mm, d_mm, e, o, c;
  };
  const Row table[] = {{502, 500, .0086, .9912, .0001},   {996, 1000, .0081, .9867, .0053},
                       {1493, 1500, .0079, .9680, .0242}, {1988, 2000, .0076, .9407, .0517},
                       {2495, 2500, .0075, .8991, .0934}, {2987, 3000, .0071, .8722, .1207}};
  Sensor s;
  s.model = Model::li2014;
  s.aperture_rad = 15 * kDegree;
  for (const Row& row : table) {
    const auto m = evaluate(s, row.range_mm / 1000, row.d_mm / 1000, 0);
    // The formula gives .96794 where .9680 is printed.
    EXPECT_NEAR(m.o, row.o, row.range_mm == 1493 ? 7e-5 : 5.1e-5) << row.range_mm;
    EXPECT_NEAR(m.e, row.e, 5.1e-5) << row.range_mm;
    EXPECT_NEAR(m.c, row.c, 5.1e-5) << row.range_mm;
    EXPECT_NEAR(m.u, 0, 1e-6) << row.range_mm;
  }
}

// Oriolo, Ulivi & Vendittelli 1997 with kE .1, kO .5, Δ .15 m, ρv 1.2 m: ρ(ρv) = ½; on the arc 1 and 3/4 of kO.
TEST(PublishedModels, Oriolo1997) {
  Sensor s;
  s.model = Model::oriolo1997;
  s.aperture_rad = 25 * kDegree;
  const auto rho = [](double d_m) { return 1 - (1 + std::tanh(2 * (d_m - 1.2))) / 2; };
  EXPECT_NEAR(evaluate(s, 2, 1.2, 0).e, 0.05, 1e-6);
  EXPECT_EQ(evaluate(s, 2, 1.2, 0).o, 0);
  EXPECT_NEAR(evaluate(s, 2, 2, 0).o, 0.5 * rho(2), 1e-6);
  EXPECT_NEAR(evaluate(s, 2, 2, 0).e, 0, 1e-6);
  EXPECT_NEAR(evaluate(s, 2, 1.925, 0).e, 0.1 * rho(1.925) / 4, 1e-6);
  EXPECT_NEAR(evaluate(s, 2, 1.925, 0).o, 0.75 * 0.5 * rho(1.925), 1e-6);
  EXPECT_NEAR(evaluate(s, 2, 2.075, 0).o, 0.75 * 0.5 * rho(2.075), 1e-6);
  const double gamma = 1 - 0.5 * (10 * kDegree) * (10 * kDegree);  // γ, degrees as printed
  EXPECT_NEAR(evaluate(s, 2, 1.2, 10 * kDegree).e, 0.05 * gamma, 1e-6);
  EXPECT_EQ(evaluate(s, 2, 1.2, 12.6 * kDegree).u, 1);
  EXPECT_EQ(evaluate(s, 2, 2.16, 0).u, 1);
}

// Li, Huang & Dezert 2006, figures 14.3 to 14.6: raw values on the axis at R = 1.5 m, here divided by their sum.
TEST(PublishedModels, Li2006OnTheAxis) {
  struct Row {
    double epsilon_m, d_m, e, o, u, c;
  };
  const Row rows[] = {
      {0.05, 0.75, .7500, .1850, 0, .2489}, {0.05, 1.0, .5556, .4724, 0, .7156}, {0.05, 1.2, .3600, .7634, 0, .9289},
      {0.05, 1.4, .1289, .9704, 0, 1.0000}, {0.05, 1.5, 0, 1, 0, .9822},         {0.05, 0.5, .8889, .0498, 0, 0},
      {0.10, 1.6, 0, .9704, .1974, 0},      {0.50, 2.0, 0, .4724, .7616, 0},     {1.50, 3.0, 0, .0012, .9951, 0}};
  for (const Row& row : rows) {
    Sensor s;
    s.model = Model::li2006;
    s.li2006.epsilon_m = row.epsilon_m;
    const double sum = row.e + row.o + row.u + row.c;
    const auto m = evaluate(s, 1.5, row.d_m, 0);
    EXPECT_NEAR(m.e, row.e / sum, 6e-5) << row.d_m;
    EXPECT_NEAR(m.o, row.o / sum, 6e-5) << row.d_m;
    EXPECT_NEAR(m.u, row.u / sum, 6e-5) << row.d_m;
    EXPECT_NEAR(m.c, row.c / sum, 6e-5) << row.d_m;
  }
}

// Eq. (14.10): half way to the edge λ = ¾. Printed, all four masses have it as a factor and dividing cancels it.
TEST(PublishedModels, Li2006DiscountsByLambda) {
  Sensor s;
  s.model = Model::li2006;
  s.aperture_rad = 25 * kDegree;
  const auto axis = evaluate(s, 1.5, 1, 0), beside = evaluate(s, 1.5, 1, 6.25 * kDegree);
  EXPECT_NEAR(beside.e, 0.75 * axis.e, 1e-6);
  EXPECT_NEAR(beside.c, 0.75 * axis.c, 1e-6);
  EXPECT_NEAR(beside.u, 0.25, 1e-6);
  s.li2006.discount_by_lambda = false;
  const auto printed = evaluate(s, 1.5, 1, 6.25 * kDegree);
  EXPECT_NEAR(printed.e, axis.e, 1e-6);
  EXPECT_NEAR(printed.u, 0, 1e-6);
}

// Eq. (14.13) with λ' = ½ at d = ρv = 1.2 m: ¼ before the arc, ½ at R − ε and R + ε, ¾ at R, and between.
TEST(PublishedModels, Probability14_13) {
  Sensor s;
  s.model = Model::probability;
  for (const auto& [range_m, p] : {std::pair{2.0, 0.25},
                                   {1.4, 0.25},
                                   {1.35, 0.3125},
                                   {1.3, 0.5},
                                   {1.25, 0.6875},
                                   {1.2, 0.75},
                                   {1.15, 0.6875},
                                   {1.1, 0.5}}) {
    const auto m = evaluate(s, range_m, 1.2, 0);
    EXPECT_NEAR(m.o, p, 3e-6) << range_m;
    EXPECT_NEAR(m.e, 1 - p, 3e-6) << range_m;
    EXPECT_EQ(m.u, 0);
  }
}

// Eq. (14.16): the repaired fΩ is Oriolo's, the printed one is kO before the arc and least where the echo is.
TEST(PublishedModels, FuzzyRepairedAndAsPrinted) {
  Sensor s;
  s.model = Model::fuzzy;
  EXPECT_NEAR(evaluate(s, 1.2, 1.2, 0).o, 0.25, 1e-6);
  EXPECT_EQ(evaluate(s, 2, 1.2, 0).o, 0);
  EXPECT_NEAR(evaluate(s, 2, 1.2, 0).e, 0.05, 1e-6);
  EXPECT_NEAR(evaluate(s, 2, 1.2, 0).u, 0.95, 1e-6);
  s.fuzzy.as_printed = true;
  EXPECT_NEAR(evaluate(s, 1.2, 1.2, 0).o, 0, 1e-6);
  EXPECT_NEAR(evaluate(s, 2, 1.2, 0).o, 0.25, 1e-6);
  EXPECT_NEAR(evaluate(s, 1.25, 1.2, 0).o, 0.25 / 4, 3e-6);
  EXPECT_NEAR(evaluate(s, 2, 1.2, 0).c, 0.05 * 0.25, 1e-6);  // both at once
}

// Eq. (14.18).
TEST(PublishedModels, FuzzyMap14_18) {
  EXPECT_EQ(evigrid::fuzzy_map(0, 0), 1);
  EXPECT_EQ(evigrid::fuzzy_map(1, 0), 0);
  EXPECT_EQ(evigrid::fuzzy_map(0, 1), 1);
  EXPECT_NEAR(evigrid::fuzzy_map(0.5, 0.5), 0.929688, 5e-7);
}

// Moravec & Elfes 1985: E is 1 at Rmin and falls to 0 at R − ε; O is shared by the cells of the arc, N = 8ωεR/(9c²).
TEST(PublishedModels, Moravec1985) {
  Sensor s;
  s.model = Model::moravec1985;
  s.aperture_rad = 30 * kDegree;
  s.min_range_m = 0.5;
  EXPECT_NEAR(evaluate(s, 2, 0.5, 0).e, 1, 1e-5);
  EXPECT_NEAR(evaluate(s, 2, 1.2, 0).e, 0.75, 1e-5);
  EXPECT_NEAR(evaluate(s, 2, 1.2, 7.5 * kDegree).e, 0.75 * 0.75, 1e-5);
  EXPECT_NEAR(evaluate(s, 2, 1.9, 0).e, 0, 1e-5);
  const double cells = 8.0 / 9 * 30 * kDegree * 0.1 * 2 / (0.05 * 0.05);
  EXPECT_NEAR(evaluate(s, 2, 2, 0, 0.05).o, 1 / cells, 1e-6);
  EXPECT_NEAR(evaluate(s, 2, 2.05, 0, 0.05).o, 0.75 / cells, 1e-6);
  EXPECT_NEAR(evaluate(s, 2, 2, 0, 0.5).o, 1, 1e-5);  // never more than one cell's
}

// Where E or O is 1, on the axis, no float error may carry a membership beyond it: for a point and in a map.
TEST(PublishedModels, MembershipsStayWithinOne) {
  std::mt19937_64 engine(31);
  std::uniform_real_distribution<double> unit(0, 1);
  double most = 0, least = 1;
  for (int n = 0; n < 3000; ++n) {
    Sensor s;
    s.model = std::array{Model::moravec1985, Model::fuzzy, Model::oriolo1997}[n % 3];
    s.aperture_rad = (1 + 38 * unit(engine)) * kDegree;
    s.min_range_m = 0.5;
    s.moravec.epsilon_m = 0.01 + 0.1 * unit(engine);
    s.fuzzy = {.k_empty = 1, .k_occupied = 1, .rho_v_m = 10};
    s.oriolo = {.k_empty = 1, .k_occupied = 1, .rho_v_m = 10};
    const float range_m = 1;
    const auto peak = evaluate(s, range_m, range_m, 0, 0.5), near = evaluate(s, range_m, 0.5, 0, 0.5);
    evigrid::Map map({.cell_m = 0.5, .rule = evigrid::Rule::fuzzy});
    const evigrid::Reading reading{map.add(s), {&range_m, 1}};
    map.integrate(evigrid::Scan{1, {0.25, 0.25, 0}, {&reading, 1}});
    const evigrid::Mass far_cell = map.mass({2, 0}), near_cell = map.mass({1, 0});
    EXPECT_GE(std::min(far_cell.u, near_cell.u), 0);
    const std::array all{peak.o, near.e, static_cast<double>(far_cell.o), static_cast<double>(near_cell.e)};
    most = std::max(most, *std::max_element(all.begin(), all.end()));
    least = std::min(least, *std::min_element(all.begin(), all.end()));
  }
  EXPECT_LE(most - 1, 0);
  EXPECT_GE(least, 1 - 1e-6);
}

TEST(PublishedModels, OutsideTheSupportIsVacuous) {
  for (Model model : evigrid::all_models()) {
    Sensor s;
    s.model = model;
    if (model == Model::beam) s.beam_step_rad = 1 * kDegree;
    for (auto [d_m, theta_rad] : {std::pair{4.0, 0.0}, {0.05, 0.0}, {1.5, 0.5}}) {
      if (model == Model::beam && theta_rad != 0) continue;  // a beam has no opening of its own
      const auto m = evaluate(s, 2, d_m, theta_rad);
      EXPECT_TRUE(m.e == 0 && m.o == 0 && m.u == 1 && m.c == 0) << name(model) << ' ' << d_m << ' ' << theta_rad;
    }
  }
}

// The kernels behind evaluate() against libm in double, all over the cones, with a reliability.
TEST(PublishedModels, EvaluateFollowsTheFormulas) {
  std::mt19937_64 engine(23);
  std::uniform_real_distribution<double> unit(0, 1);
  double worst = 0;
  for (int n = 0; n < 20'000; ++n) {
    Sensor s;
    s.model = n % 2 == 0 ? Model::li2014 : Model::hughes1992;
    s.reliability = 0.7 + 0.3 * unit(engine);
    const double range_m = 0.3 + 4.5 * unit(engine), half = s.aperture_rad / 2;
    const double theta_rad = half * (1.98 * unit(engine) - 0.99), d_m = 0.15 + (range_m - 0.15) * unit(engine);
    if (s.model == Model::hughes1992 && std::fabs(d_m - (range_m - 0.15)) < 1e-3) continue;  // at the step
    const oracle::EdgeAngles angles{half - theta_rad, half + theta_rad};
    const auto zone = d_m < range_m - 0.15 ? oracle::Zone::empty : oracle::Zone::occupied;
    const oracle::Source want = discount(
        s.model == Model::li2014 ? li2014(s.li, range_m, d_m, angles) : hughes1992(s.hughes, d_m, angles, zone),
        s.reliability);
    const auto got = evaluate(s, range_m, d_m, theta_rad);
    worst = std::max({worst, std::fabs(got.e - want.x), std::fabs(got.o - want.y), std::fabs(got.c - want.z),
                      std::fabs(got.u - want.v)});
  }
  EXPECT_LE(worst, 2e-6);
  std::printf("largest error evaluate: %.3g\n", worst);
}

TEST(PublishedModels, ComposedPosesAreRightToTheLastBits) {
  std::mt19937_64 engine(29);
  std::uniform_real_distribution<double> place(-50, 50), turn(-3, 3);
  for (int n = 0; n < 10'000; ++n) {
    const double far = n % 2 == 0 ? 0 : 5e5;
    const Pose2 a{place(engine) + far, place(engine) + 10 * far, turn(engine)};
    const Pose2 b{place(engine) / 50, place(engine) / 50, turn(engine)};
    const long double c = std::cos(static_cast<long double>(a.yaw_rad)),
                      s = std::sin(static_cast<long double>(a.yaw_rad));
    const Pose2 got = compose(a, b);
    EXPECT_NEAR(got.x_m, static_cast<double>(a.x_m + (c * b.x_m - s * b.y_m)), 2e-15 * (std::fabs(a.x_m) + 2));
    EXPECT_NEAR(got.y_m, static_cast<double>(a.y_m + (s * b.x_m + c * b.y_m)), 2e-15 * (std::fabs(a.y_m) + 2));
    EXPECT_NEAR(std::remainder(got.yaw_rad - a.yaw_rad - b.yaw_rad, 2 * std::numbers::pi), 0, 2e-15);
  }
}

}  // namespace
