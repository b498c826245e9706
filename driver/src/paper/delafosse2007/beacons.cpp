// SPDX-License-Identifier: Apache-2.0
#include "paper/delafosse2007/beacons.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "evigrid/combine.hpp"
#include "evigrid/frame.hpp"

namespace evigrid::driver {
namespace {

constexpr double kMostMass = 0.95;      // of figure 9: one distance alone never decides for good
constexpr std::size_t kCandidates = 7;  // and *: as many as a frame holds

}  // namespace

Placed placed(const Primitive& p, const scenes::Pose& platform) {
  Placed out{{INFINITY, -INFINITY}, {INFINITY, -INFINITY}, p.exists};
  for (const double x : {p.x.low, p.x.high}) {
    for (const double y : {p.y.low, p.y.high}) {
      const scenes::Pose c = compose(platform, scenes::Pose{x, y, 0});
      out.x = {std::min(out.x.low, c.x_m), std::max(out.x.high, c.x_m)};
      out.y = {std::min(out.y.low, c.y_m), std::max(out.y.high, c.y_m)};
    }
  }
  return out;
}

Existence fused(const Existence& a, const Existence& b) {
  std::array<double, 4> p{a.no, a.yes, a.ignorance(), a.empty};
  const std::array<double, 4> q{b.no, b.yes, b.ignorance(), b.empty};
  combine(Rule::conjunctive, Planes<const double>{&p[0], &p[1], &p[2], &p[3]},
          Planes<const double>{&q[0], &q[1], &q[2], &q[3]}, Planes<double>{&p[0], &p[1], &p[2], &p[3]}, nullptr, 1);
  return {p[1], p[0], p[3]};
}

Existence certainty_of_match(double p) noexcept {
  return p >= 0.5 ? Existence{2 * p - 1, 0, 0} : Existence{0, 1 - 2 * p, 0};
}

Association associate(const Placed& primitive, const std::vector<Beacon>& beacons, const std::vector<bool>& taken,
                      double gate_m) {
  std::vector<std::pair<double, int>> near;
  const raycast::Point at = primitive.centre();
  for (std::size_t i = 0; i < beacons.size(); ++i) {
    const double d = std::hypot(beacons[i].centre.x_m - at.x_m, beacons[i].centre.y_m - at.y_m);
    if (!taken[i] && d < 2 * gate_m) near.emplace_back(d, static_cast<int>(i));
  }
  if (near.empty()) return {-1, 1};
  std::sort(near.begin(), near.end());
  if (near.size() > kCandidates) near.resize(kCandidates);
  std::vector<std::string> names{"*none"};
  for (const auto& [d, i] : near) names.push_back(fmt::format("Q{}", i));
  const Frame frame(names);
  std::vector<Belief> sources;
  for (std::size_t k = 0; k < near.size(); ++k) {
    const double d = near[k].first;
    const Subset q = frame.hypothesis(k + 1);
    Belief b = vacuous(frame);
    const double mass = kMostMass * std::min(1.0, std::abs(1 - d / gate_m));
    b.m[d < gate_m ? q : frame.everything() & ~q] = mass;
    b.m[frame.everything()] = 1 - mass;
    sources.push_back(std::move(b));
  }
  const Belief all = combine(Rule::dubois_prade, frame, sources).belief;
  const std::size_t chosen = decide(frame, all);
  const double p = pignistic(frame, all, frame.hypothesis(chosen));
  return {chosen == 0 ? -1 : near[chosen - 1].second, p};
}

}  // namespace evigrid::driver
