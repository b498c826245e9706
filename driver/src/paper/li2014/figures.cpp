// SPDX-License-Identifier: Apache-2.0
#include "paper/li2014/figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "evigrid/evigrid.hpp"
#include "evigrid/raycast/noise.hpp"
#include "mapping.hpp"

namespace evigrid::driver {
namespace {

constexpr std::array<AxisRow, 6> kTable3{{{502, 500, .0086, .9912, .0001},
                                          {996, 1000, .0081, .9867, .0053},
                                          {1493, 1500, .0079, .9680, .0242},
                                          {1988, 2000, .0076, .9407, .0517},
                                          {2495, 2500, .0075, .8991, .0934},
                                          {2987, 3000, .0071, .8722, .1207}}};

template <class T>
struct Source {
  std::vector<T> e, o, u;
  explicit Source(std::size_t n) : e(n), o(n), u(n) {}
  Planes<const T> in() const { return {e.data(), o.data(), u.data(), nullptr}; }
  Planes<T> out() { return {e.data(), o.data(), u.data(), nullptr}; }
};

/// Uniform on the simplex: the gaps between two sorted uniform numbers.
template <class T>
Source<T> draw(std::uint64_t seed, std::uint32_t which, std::size_t n) {
  Source<T> s(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto unit = [&](std::uint32_t k) {
      return static_cast<double>(raycast::random_bits({seed, which, 0, i}, k) >> 11) * 0x1p-53;
    };
    const double a = unit(0), b = unit(1), low = std::min(a, b), high = std::max(a, b);
    s.e[i] = static_cast<T>(low), s.o[i] = static_cast<T>(high - low), s.u[i] = static_cast<T>(1 - high);
  }
  return s;
}

template <class Work>
double fastest_ms(double so_far, const Work& work) {
  const auto begin = Clock::now();
  work();
  return std::min(so_far, 1e3 * seconds_since(begin));
}

}  // namespace

RuleComparison compare_rules(std::uint64_t seed, std::size_t pairs) {
  constexpr std::size_t kGroups = 50'000;
  constexpr int kRounds = 20;
  const auto a = draw<double>(seed, 0, pairs), b = draw<double>(seed, 1, pairs);
  Source<double> two(pairs), five(pairs);
  const auto cell = draw<float>(seed, 2, kGroups), reading = draw<float>(seed, 3, kGroups);
  Source<float> fused(kGroups);
  RuleComparison r{.pairs = pairs, .pcr2_ms = INFINITY, .pcr5_ms = INFINITY, .groups_ms = INFINITY};
  for (int round = 0; round < kRounds; ++round) {
    r.pcr2_ms = fastest_ms(r.pcr2_ms, [&] { combine(Rule::pcr2, a.in(), b.in(), two.out(), nullptr, pairs); });
    r.pcr5_ms = fastest_ms(r.pcr5_ms, [&] { combine(Rule::pcr5, a.in(), b.in(), five.out(), nullptr, pairs); });
    r.groups_ms = fastest_ms(r.groups_ms,
                             [&] { combine(Rule::germ_pcr2, cell.in(), reading.in(), fused.out(), nullptr, kGroups); });
  }
  const double share = 1.0 / static_cast<double>(pairs);
  for (std::size_t i = 0; i < pairs; ++i) {
    r.mean[0] += share * (two.e[i] - five.e[i]);
    r.mean[1] += share * (two.o[i] - five.o[i]);
    r.mean[2] += share * (two.u[i] - five.u[i]);
    const double d = std::abs(two.e[i] - five.e[i]);
    r.mean_absolute += share * d;
    r.largest = std::max(r.largest, d);
    r.decide_otherwise += share * ((two.o[i] > two.e[i]) != (five.o[i] > five.e[i]));
  }
  return r;
}

std::vector<ErrorAtDistance> errors_by_distance(const scenes::Scene& robot) {
  constexpr std::uint64_t kReadings = 20;
  const scenes::SonarSpec& sonar = robot.sonars.at(0);
  std::vector<ErrorAtDistance> out;
  for (std::uint32_t step = 1; step <= 8; ++step) {
    const double distance_m = 0.5 * step;
    raycast::World world;
    world.walls.push_back({{distance_m, -1}, {distance_m, 1}, {}});
    const raycast::Scene caster(world);
    const raycast::Echo echo = caster.cast_cone({0, 0, 0, sonar.aperture_rad, sonar.min_range_m, 5});
    double sum = 0;
    for (std::uint64_t n = 0; n < kReadings; ++n)
      sum += raycast::noisy(echo.range_m, sonar.noise, {robot.trajectory.seed, 0, step, n}) - distance_m;
    out.push_back({distance_m, sum / static_cast<double>(kReadings)});
  }
  return out;
}

const std::array<AxisRow, 6>& table3() noexcept { return kTable3; }

std::array<AxisRow, 6> table3_ours() {
  Sensor s;
  s.model = Model::li2014;
  s.aperture_rad = 15 * std::numbers::pi / 180;
  s.max_range_m = 3;
  std::array<AxisRow, 6> out = kTable3;
  for (AxisRow& row : out) {
    const ModelMass m = evaluate(s, row.reading_mm / 1000, row.distance_mm / 1000, 0);
    row.e = m.e, row.o = m.o, row.c = m.c;
  }
  return out;
}

}  // namespace evigrid::driver
