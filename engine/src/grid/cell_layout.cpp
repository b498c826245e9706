// SPDX-License-Identifier: Apache-2.0
#include "grid/cell_layout.hpp"

#include <limits>

#include "rule_kernels.hpp"

namespace evigrid {
namespace {

using namespace kernels;

constexpr float kSum = 1.001f;  // rounding may end above 1
constexpr float kEndless = std::numeric_limits<float>::max(), kWhole = 16777216, kRest = 4194304;

struct StateRow {
  RuleKernel kernel;
  int count;
  Plane plane[kMostPlanes];
};
// States of kernels/cell/state.hpp and state_sums.hpp, plane by plane; of the kernels not listed, the first row.
constexpr StateRow kRows[] = {
    {kDempster, 3, {{"e", 0, 0, kSum}, {"o", 0, 0, kSum}, {"u", 1, 0, kSum}}},
    {kConjunctive, 4, {{"e", 0, 0, kSum}, {"o", 0, 0, kSum}, {"u", 1, 0, kSum}, {"c", 0, 0, kSum}}},
    {kCautious, 2, {{"weight_empty", 0, 0, kEndless}, {"weight_occupied", 0, 0, kEndless}}},
    {kMurphy,
     5,
     {{"sum_empty", 0, -kWhole, kWhole},
      {"sum_empty_rest", 0, -kRest, kRest},
      {"sum_occupied", 0, -kWhole, kWhole},
      {"sum_occupied_rest", 0, -kRest, kRest},
      {"readings", 0, -kWhole, kWhole}}},
    {kBayes, 1, {{"log_odds", 0, -kEndless, kEndless}}},
    {kFuzzy, 2, {{"member_empty", 0, 0, kSum}, {"member_occupied", 0, 0, kSum}}},
    {kDempsterLog,
     4,
     {{"log_weight_empty", 0, -kWhole, kWhole},
      {"log_weight_empty_rest", 0, -kRest, kRest},
      {"log_weight_occupied", 0, -kWhole, kWhole},
      {"log_weight_occupied_rest", 0, -kRest, kRest}}},
};

const StateRow& row_of(Rule rule) noexcept {
  for (const StateRow& row : kRows) {
    if (row.kernel == kernel_of(rule)) return row;
  }
  return kRows[0];
}

}  // namespace

bool state_is_sum(Rule rule) noexcept {
  const RuleKernel k = kernel_of(rule);
  return k == kDempsterLog || k == kMurphy;
}

bool state_is_masses(Rule rule) noexcept { return row_of(rule).plane[0].name == "e"; }

std::vector<Plane> planes_of(const MapParams& p) {
  const StateRow& row = row_of(p.rule);
  std::vector<Plane> out(row.plane, row.plane + row.count);
  if (p.keep_conflict) out.push_back({"conflict", 0, 0, kEndless});
  if (p.keep_con) out.push_back({"con", 0, 0, kEndless});
  if (p.keep_last_conflict)  // memberships may both be whole: e·ω + o·ψ is at most 2
    out.push_back({"last_conflict", 0, 0, row.kernel == kFuzzy ? 2 * kSum : kSum});
  if (p.decay_s > 0) {
    out.push_back({"stamp_low", 0, 0, 0, true});
    out.push_back({"stamp_high", 0, 0, 0, true});
    out.push_back({"decay_s", 0, 0, kEndless});
  }
  return out;
}

CellLayout cell_layout(const MapParams& p, const KernelTable& table) {
  CellLayout out;
  out.planes = planes_of(p);
  int next = row_of(p.rule).count;
  out.state = next;
  out.planes_are_masses = state_is_masses(p.rule);
  if (out.planes_are_masses && next > 3) out.paradox = 3;
  if (p.keep_conflict) out.conflict = next++;
  if (p.keep_con) out.con = next++;
  if (p.keep_last_conflict) out.last_conflict = next++;
  if (p.decay_s > 0) out.age = next;
  if (out.planes_are_masses && out.paradox < 0) out.render_costs = table.render_costs;
  out.read_out = table.read_out[kernel_of(p.rule)];
  return out;
}

}  // namespace evigrid
