// SPDX-License-Identifier: Apache-2.0
// li2006 is certain on its axis. Under Dempster's rule and PCR4 two certainties that contradict each other leave next
// to nothing, and that decides: is the error of a map then the rule's or the source's? The engine's own float masses
// are fed to the rule in double; what is left between that and the map is the rule's. (An m(unknown) of −1.2e-7 / sum
// before R, from 1 − 2^0 by a polynomial, was seen here as 1.1e-5 of a mass.)
#include <numbers>
#include <random>

#include "kernels/row/compile_reading.hpp"
#include "kernels/row/kernel_table.hpp"
#include "tests/oracle/compare_maps.hpp"
#include "tests/oracle/set_rules.hpp"

namespace {

using namespace oracle;
using evigrid::CellIndex;
using evigrid::Model;
using evigrid::Pose2;
using evigrid::Rule;
using evigrid::Sensor;
namespace k = evigrid::kernels;

constexpr double kCell_m = 0.1;

/// What the kernels say of one cell, as sums of floats; false outside.
bool measured(const Sensor& s, const Pose2& pose, float range_m, CellIndex cell, Source& out) {
  k::ConeSpec spec{};
  spec.model = k::kLi2006;
  spec.cell_m = kCell_m, spec.aperture_rad = s.aperture_rad;
  spec.min_range_m = s.min_range_m, spec.max_range_m = s.max_range_m, spec.reliability = s.reliability;
  spec.li2006_rho_v = s.li2006.rho_v, spec.li2006_epsilon_m = s.li2006.epsilon_m;
  spec.discount_by_lambda = s.li2006.discount_by_lambda;
  spec.reliability_if_empty = spec.reliability_if_occupied = 1;
  const k::ConeReading q = k::compile_cone(k::ConeType(spec), {pose.x_m, pose.y_m, pose.yaw_rad}, range_m);
  const float x0[1 + k::kConeAhead] = {static_cast<float>(cell.x - q.i0) - q.fx};
  const float y0[1 + k::kConeAhead] = {static_cast<float>(cell.y - q.j0) - q.fy};
  k::ConeArgs args;
  args.zone[k::kRim] = {nullptr, x0, y0, 1};
  auto m = std::make_unique<k::Measured>();
  k::find_table("auto")->measure_cone[k::kDsmh][spec.model](args, q, *m);  // a rule that takes all masses as they are
  if ((m->inside[0] & 1) == 0) return false;
  const double x = m->part[0][0], y = m->part[1][0], v = m->part[2][0], z = m->part[3][0], sum = x + y + v + z;
  out = {x / sum, y / sum, z / sum, v / sum};
  return true;
}

void join(Rule rule, ReferenceCell& c, const Source& s) {
  Belief<double, 3> state{}, said{};
  state[kEmpty] = c.e, state[kOccupied] = c.o, state[kUnknown] = c.u;
  said[kEmpty] = s.x, said[kOccupied] = s.y, said[kUnknown] = s.v, said[kBoth] = s.z;
  const auto fused = combine<double, 3>(rule, cell_frame(), state, said, 1e-12);
  c.e = fused.m[kEmpty] < 1e-12 ? 0 : fused.m[kEmpty];
  c.o = fused.m[kOccupied] < 1e-12 ? 0 : fused.m[kOccupied];
  c.u = std::max(fused.m[kUnknown], 1e-30);
}

double apart(const evigrid::Mass& m, const ReferenceCell& c) {
  return std::max({std::fabs(m.e - c.e), std::fabs(m.o - c.o), std::fabs(m.u - c.u)});
}

TEST(CertainSource, WhatAContradictionAmplifiesIsTheModelsError) {
  for (Rule rule : {Rule::dempster, Rule::pcr4}) {
    Both both({.cell_m = kCell_m, .rule = rule});
    struct Said {
      Sensor sensor;
      Pose2 pose;
      float range_m;
    };
    std::vector<Said> said;
    std::vector<evigrid::SensorId> ids;
    std::vector<Sensor> sensors;
    for (int i = 0; i < 24; ++i) {
      Sensor s;
      s.model = Model::li2006;
      s.aperture_rad = 25 * std::numbers::pi / 180, s.min_range_m = 0.1, s.max_range_m = 5, s.reliability = 1;
      const double bearing = i * 2 * std::numbers::pi / 24;
      s.T_robot_sensor = {0.353 * std::cos(bearing), 0.353 * std::sin(bearing), bearing};
      ids.push_back(both.add(s)), sensors.push_back(s);
    }
    std::mt19937_64 engine(17);
    std::uniform_real_distribution<double> unit(0, 1);
    Pose2 pose{0.2, 0.1, 0.05};
    for (int n = 0; n < 30; ++n) {
      std::vector<float> ranges;
      for (int i = 0; i < 24; ++i) ranges.push_back(static_cast<float>(0.1 + 3.9 * unit(engine)));
      std::vector<evigrid::Reading> readings;
      for (int i = 0; i < 24; ++i) {
        readings.push_back({ids[i], {&ranges[i], 1}});
        said.push_back({sensors[i], compose(pose, sensors[i].T_robot_sensor), ranges[i]});
      }
      both.integrate(evigrid::Scan{n + 1, pose, readings});
      pose.x_m += 0.06 * unit(engine), pose.y_m += 0.05 * unit(engine), pose.yaw_rad += 0.3 * (unit(engine) - 0.4);
    }
    std::vector<std::pair<double, CellIndex>> cells;
    for (const auto& [index, want] : both.reference().cells())
      cells.emplace_back(apart(both.engine().mass(index), want), index);
    std::sort(cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    const double whole = cells.front().first;
    double of_rule = 0;
    for (std::size_t n = 0; n < 40; ++n) {
      ReferenceCell replay;
      for (const Said& r : said) {
        Source s;
        if (measured(r.sensor, r.pose, r.range_m, cells[n].second, s)) join(rule, replay, s);
      }
      of_rule = std::max(of_rule, apart(both.engine().mass(cells[n].second), replay));
    }
    EXPECT_LE(whole, kMassBound) << name(rule);
    EXPECT_LE(of_rule, 5e-7) << name(rule);
    std::printf("%s: whole %.3g, of the rule %.3g\n", std::string(name(rule)).c_str(), whole, of_rule);
  }
}

}  // namespace
