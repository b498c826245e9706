// SPDX-License-Identifier: Apache-2.0
// Every cone model of the kernels against libm in double, over its whole domain: random parameters within the table's
// ranges, random cells, apertures and readings; every cell of a tile somewhere on the cone. And 2^y over every float
// that the models can hand it (EVIGRID_EXHAUSTIVE=1; else every 64th).
#include <gtest/gtest.h>

#include <bit>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <numeric>
#include <random>

#include "evigrid/evigrid.hpp"
#include "kernels/cell/lane_scalar.hpp"
// After the lane.
#include "kernels/cell/poly.hpp"
#include "kernels/row/compile_reading.hpp"
#include "kernels/row/kernel_table.hpp"
#include "tests/exhaustive.hpp"
#include "tests/oracle/reference_lattice.hpp"
#include "tests/oracle/reference_model.hpp"

namespace {

using namespace oracle;
using evigrid::Model;
using evigrid::Sensor;

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double between(double a, double b) { return a + (b - a) * unit_(engine_); }
  /// As likely in every decade; a 0 is possible where the range has one.
  double by_decade(double a, double b) {
    if (a <= 0) return between(0, 1) < 0.1 ? 0 : by_decade(b * 1e-4, b);
    return a * std::pow(b / a, between(0, 1));
  }

 private:
  std::mt19937_64 engine_;
  std::uniform_real_distribution<double> unit_{0, 1};
};

struct Case {
  Sensor sensor;
  double cell_m = 0.05, range_m = 1;
};

Case draw(Model model, Dice& dice) {
  Case c;
  Sensor& s = c.sensor;
  s.model = model;
  c.cell_m = dice.by_decade(0.01, 0.5);
  s.aperture_rad = dice.between(0.0088, 0.699);
  s.min_range_m = dice.between(0, 1) < 0.3 ? 0.001 : dice.by_decade(0.001, 0.5);
  s.max_range_m = std::min(dice.by_decade(1, 50), 60000 * c.cell_m);
  s.reliability = dice.between(0, 1) < 0.3 ? 1 : dice.between(0.3, 1);
  if (dice.between(0, 1) < 0.8)
    for (const auto& p : evigrid::model_params(model))
      set_model_param(s, model, p.name, p.is_switch ? std::round(dice.between(0, 1)) : dice.by_decade(p.least, p.most));
  c.range_m = static_cast<float>(dice.by_decade(std::max(s.min_range_m, 0.01 * s.max_range_m), s.max_range_m));
  return c;
}

/// The largest error of one tile whose middle lies at (d, angle) on the cone, both as shares; cells seen are counted.
double error_of(const Case& c, double along, double beside, double heading_rad, std::uint64_t& seen) {
  namespace k = evigrid::kernels;
  const Sensor& s = c.sensor;
  const double cell = c.cell_m, reach = reach_cells(s, cell);
  k::ConeSpec spec{};
  const int cone = static_cast<int>(s.model);
  constexpr int kOf[] = {k::kHughes1992,  k::kOriolo1997, k::kLi2006,     k::kLi2014,
                         k::kProbability, k::kFuzzyModel, k::kMoravec1985};
  spec = {kOf[cone],
          cell,
          s.aperture_rad,
          s.min_range_m,
          s.max_range_m,
          s.reliability,
          s.hughes.r_max_m,
          s.hughes.max_occupied,
          s.hughes.tolerance_m,
          s.li.rho_e,
          s.li.rho_o,
          s.li.rho_c,
          s.li.rho_i,
          s.li.epsilon_ratio};
  spec.width_m = arc_m(s);
  spec.rho_v_m = s.model == Model::fuzzy         ? s.fuzzy.rho_v_m
                 : s.model == Model::probability ? s.probability.rho_v_m
                                                 : s.oriolo.rho_v_m;
  spec.k_empty = s.model == Model::fuzzy ? s.fuzzy.k_empty : s.oriolo.k_empty;
  spec.k_occupied = s.model == Model::fuzzy ? s.fuzzy.k_occupied : s.oriolo.k_occupied;
  spec.as_printed = s.fuzzy.as_printed;
  spec.li2006_rho_v = s.li2006.rho_v, spec.li2006_epsilon_m = s.li2006.epsilon_m;
  spec.discount_by_lambda = s.li2006.discount_by_lambda;
  spec.moravec_epsilon_m = s.moravec.epsilon_m;
  const k::ConeType type(spec);
  const k::ConeReading q = k::compile_cone(type, {0.013, 0.027, heading_rad}, c.range_m);
  const double d_middle = along * q.outer, turn = heading_rad + beside * s.aperture_rad;
  const float x0 = static_cast<float>(std::floor(d_middle * std::cos(turn)) - 32 - q.fx);
  const float y0 = static_cast<float>(std::floor(d_middle * std::sin(turn)) - 32 - q.fy);
  std::array<float, 256 + k::kConeAhead> x{}, y{};
  for (std::size_t i = 0; i < 256; ++i) {
    x[i] = x0 + static_cast<float>(i % 16 * 4);
    y[i] = y0 + static_cast<float>(i / 16 * 4);
  }
  k::ConeArgs args;
  args.zone[k::kRim] = {nullptr, x.data(), y.data(), 256};
  auto measured = std::make_unique<k::Measured>();
  const auto& table = *k::find_table("auto");
  for (const int rule : {k::kDsmh, k::kBayes, k::kFuzzy}) {  // the first that takes the source as the model makes it
    if (table.measure_cone[rule][spec.model] == nullptr) continue;
    table.measure_cone[rule][spec.model](args, q, *measured);
    break;
  }

  const Lattice lattice(reach);
  const Direction left = edge_direction(heading_rad + s.aperture_rad / 2),
                  right = edge_direction(heading_rad - s.aperture_rad / 2);
  Along at;
  at.range = lattice.round(c.range_m / cell), at.cell_m = cell;
  at.nearest = std::max(lattice.round(s.min_range_m / cell), lattice.step());
  at.width = lattice.round(arc_m(s) / cell);
  if (s.model != Model::li2006) at.width = std::max(at.width, lattice.step());
  const double occupied_from = at.range - lattice.round(s.hughes.tolerance_m / cell);
  double worst = 0;
  for (int micro = 0; micro < 256; ++micro)
    for (int i = 0; i < 16; ++i) {
      if ((measured->inside[micro] >> i & 1) == 0) continue;
      const double dx = static_cast<double>(x0) + micro % 16 * 4 + i % 4,
                   dy = static_cast<double>(y0) + micro / 16 * 4 + i / 4;  // NOLINT: rows of four
      at.d = std::sqrt(dx * dx + dy * dy);
      const EdgeAngles angles{std::atan2(cross(dx, dy, left.x, left.y), dx * left.x + dy * left.y),
                              std::atan2(cross(right.x, right.y, dx, dy), dx * right.x + dy * right.y)};
      const Source want =
          discount(cone_model(s, at, angles, at.d < occupied_from ? Zone::empty : Zone::occupied), s.reliability);
      const auto part = [&](int p) { return static_cast<double>(measured->part[p][micro * 16 + i]); };
      const double sum = part(4);
      worst = std::max({worst, std::fabs(part(0) / sum - want.x), std::fabs(part(1) / sum - want.y),
                        std::fabs(part(3) / sum - want.z)});
      const bool memberships = s.model == Model::fuzzy || s.model == Model::moravec1985;
      if (!memberships) worst = std::max(worst, std::fabs(part(2) / sum - want.v));
      ++seen;
    }
  return worst;
}

class ModelError : public testing::TestWithParam<Model> {};

TEST_P(ModelError, StaysBelowTwoMillionthsOverTheWholeDomain) {
  Dice dice(41);
  double worst = 0;
  std::uint64_t seen = 0;
  const int cases = evigrid::tests::exhaustive() ? 100'000 : 1500;
  for (int n = 0; n < cases; ++n) {
    const Case c = draw(GetParam(), dice);
    ASSERT_TRUE(check(c.sensor).empty()) << check(c.sensor).front().field;
    const double error = error_of(c, dice.between(0, 1), dice.between(-0.5, 0.5), dice.between(-3.2, 3.2), seen);
    if (error > worst) {
      worst = error;
      std::string values;
      for (const auto& p : evigrid::model_params(GetParam()))
        values += ' ' + std::string(p.name) + '=' + std::to_string(*model_param(c.sensor, GetParam(), p.name));
      if (worst > 1e-6)
        std::cout << worst << ": cell " << c.cell_m << " aperture " << c.sensor.aperture_rad << " min "
                  << c.sensor.min_range_m << " max " << c.sensor.max_range_m << " R " << c.range_m << values << '\n';
    }
  }
  EXPECT_GT(seen, 100'000U);
  EXPECT_LE(worst, 2e-6);
  std::cout << "largest error of a mass, " << name(GetParam()) << ": " << worst << " over " << seen << " cells\n";
}

INSTANTIATE_TEST_SUITE_P(Models, ModelError,
                         testing::Values(Model::hughes1992, Model::oriolo1997, Model::li2006, Model::li2014,
                                         Model::probability, Model::fuzzy, Model::moravec1985),
                         [](const auto& model) { return std::string(name(model.param)); });

// 2^y = 2^n·2^f with y − n exact, so that every float f in [−½, ½] covers every y; below 2^-26 the polynomial is 1.
TEST(Polynomials, PowerOfTwoOverEveryFloat) {
  const bool all = evigrid::tests::exhaustive();
  double worst = 0;
  std::uint64_t count = 0;
  for (std::uint32_t bits = std::bit_cast<std::uint32_t>(0x1p-26f); bits <= std::bit_cast<std::uint32_t>(0.5f);
       bits += all ? 1 : 64) {
    for (const float f : {std::bit_cast<float>(bits), -std::bit_cast<float>(bits)}) {
      const double got = evigrid::kernels::scalar::exp2_poly(f);
      worst = std::max(worst, std::fabs(got / std::exp2(static_cast<double>(f)) - 1));
      ++count;
    }
  }
  EXPECT_LE(worst, 2.3e-7);
  std::cout << "largest relative error of 2^f: " << worst << " over " << count << " floats\n";
}

}  // namespace
