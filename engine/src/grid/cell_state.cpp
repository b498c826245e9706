// SPDX-License-Identifier: Apache-2.0
#include "grid/cell_state.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/row/portable_math.hpp"
#include "rule_kernels.hpp"

namespace evigrid {
namespace {

using namespace kernels;

// As kernels/cell/mass.hpp and state.hpp have them.
constexpr float kMassFloor = 1e-12f, kOpenFloor = 1e-30f;
constexpr double kLeastUnknown = 1e-4, kRestsInOne = 8388608;

/// whole + rest · 2^-23, as the sums of state_sums.hpp.
void put_sum(double value, float* planes) noexcept {
  const double whole = std::nearbyint(value);
  planes[0] = static_cast<float>(whole);
  planes[1] = static_cast<float>(std::nearbyint((value - whole) * kRestsInOne));
}
void add_sum(const float* a, const float* b, float* out) noexcept {  // whole numbers in double: exact
  double rest = static_cast<double>(a[1]) + b[1], carry = 0;
  if (rest >= 0.5 * kRestsInOne) carry = 1;
  if (rest < -0.5 * kRestsInOne) carry = -1;
  out[0] = static_cast<float>(static_cast<double>(a[0]) + b[0] + carry);
  out[1] = static_cast<float>(rest - carry * kRestsInOne);
}
float at_least(float m, float floor) noexcept { return m >= floor ? m : 0; }
double weight(double said, double unknown) noexcept { return said / std::max(unknown, kLeastUnknown); }

float within_limits(const MapParams& p, double log_odds) noexcept {
  const auto limit = [](double q) { return portable_log(q) - portable_log(1 - q); };
  return static_cast<float>(std::clamp(log_odds, limit(p.bayes.least_p), limit(p.bayes.most_p)));
}

}  // namespace

CellPlanes state_of(const MapParams& p, const Mass& m) noexcept {
  const double e = m.e, o = m.o, u = m.u;
  CellPlanes out;
  switch (kernel_of(p.rule)) {
    case kConjunctive:
      out = {
          {at_least(m.e, kOpenFloor), at_least(m.o, kOpenFloor), std::max(m.u, kOpenFloor), at_least(m.c, kOpenFloor)}};
      break;
    case kCautious:
      out = {{static_cast<float>(weight(e, u)), static_cast<float>(weight(o, u))}};
      break;
    case kMurphy:
      if (m == Mass{}) break;
      put_sum(e, out.at), put_sum(o, out.at + 2);
      out.at[4] = 1;
      break;
    case kBayes: {
      const double share = p.bayes.likelihood == Likelihood::plp ? 1 : 0.5;
      out.at[0] =
          within_limits(p, portable_log(std::max(o + share * u, 1e-12)) - portable_log(std::max(e + share * u, 1e-12)));
      break;
    }
    case kFuzzy:
      out = {{at_least(m.e, kMassFloor), at_least(m.o, kMassFloor)}};
      break;
    case kDempsterLog:
      put_sum(portable_log(1 + weight(e, u)), out.at), put_sum(portable_log(1 + weight(o, u)), out.at + 2);
      break;
    default:
      out = {{at_least(m.e, kMassFloor), at_least(m.o, kMassFloor), std::max(m.u, kOpenFloor)}};
  }
  return out;
}

CellPlanes joined(const MapParams& p, const CellPlanes& a, const CellPlanes& b) noexcept {
  CellPlanes out;
  switch (kernel_of(p.rule)) {
    case kCautious:
      out = {{std::max(a.at[0], b.at[0]), std::max(a.at[1], b.at[1])}};
      break;
    case kMurphy:
      out.at[4] = a.at[4] + b.at[4];
      [[fallthrough]];
    case kDempsterLog:
      add_sum(a.at, b.at, out.at), add_sum(a.at + 2, b.at + 2, out.at + 2);
      break;
    case kBayes:
      out.at[0] = within_limits(p, static_cast<double>(a.at[0]) + b.at[0]);
      break;
    default:  // fuzzy
      for (int i = 0; i < 2; ++i) {
        const double x = a.at[i], y = b.at[i];
        out.at[i] = at_least(static_cast<float>(x + y - x * y), kMassFloor);
      }
  }
  return out;
}

float weight_of_conflict(float k) noexcept {
  return -static_cast<float>(portable_log(std::max(1 - static_cast<double>(k), static_cast<double>(kLeastMass))));
}

std::string_view why_no_mass(Rule rule, const Mass& m) noexcept {
  for (const float part : {m.e, m.o, m.u, m.c}) {
    if (!(part >= 0 && part <= 1)) return "has a part outside [0, 1]";
  }
  if (kernel_of(rule) == kFuzzy) return {};  // memberships: two numbers that add up to anything
  if (m.c > 0 && !keeps_paradox(rule)) return "has a mass on empty ∩ occupied, which the rule does not keep";
  if (std::fabs(static_cast<double>(m.e) + m.o + m.u + m.c - 1) > 1e-5) return "does not add up to 1";
  return {};
}

}  // namespace evigrid
