// SPDX-License-Identifier: Apache-2.0
#include "picture/look.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "error.hpp"

namespace evigrid::driver {
namespace {

constexpr LookRow kRows[] = {
    {Look::betp, "betp", "BetP(occupied) = m(occupied) + m(unknown)/2", "BetP", Ramp::rdbu, Layer::betp},
    {Look::bel, "bel", "Bel(occupied) = m(occupied)", "Bel", Ramp::viridis, Layer::bel},
    {Look::pl, "pl", "Pl(occupied) = m(occupied) + m(unknown)", "Pl", Ramp::viridis, Layer::pl},
    {Look::empty, "empty", "m(empty)", "m", Ramp::viridis, Layer::empty},
    {Look::unknown, "unknown", "m(unknown)", "m", Ramp::viridis, Layer::unknown},
    {Look::ignorance, "ignorance", "ignorance = Pl(occupied) - Bel(occupied)", "Pl-Bel", Ramp::viridis,
     Layer::ignorance},
    {Look::entropy, "entropy", "entropy of BetP", "bit", Ramp::viridis, Layer::entropy},
    {Look::conflict, "conflict", "conflict met on the way: sum of k", "sum k", Ramp::oranges, Layer::conflict},
    {Look::con, "con", "weight of conflict: sum of -ln(1 - k)", "nat", Ramp::oranges, Layer::con},
    {Look::last_conflict, "last_conflict", "conflict of the last update", "k", Ramp::oranges, Layer::last_conflict},
    {Look::paradox, "paradox", "m(nothing), or of empty and occupied at once", "m", Ramp::oranges, Layer::paradox},
    {Look::commonality, "commonality", "commonality of occupied", "q", Ramp::viridis, Layer::commonality},
    {Look::plp, "plp", "PlP(occupied): plausibility, normalised", "PlP", Ramp::rdbu, Layer::plp},
    {Look::dsmp, "dsmp", "DSmP(occupied), epsilon 0.001", "DSmP", Ramp::rdbu, Layer::dsmp},
    {Look::free_betp, "free_betp", "generalised pignistic of occupied, free DSm model", "GPT", Ramp::viridis,
     Layer::free_betp},
    {Look::free_both, "free_both", "generalised pignistic of both at once, free DSm model", "GPT", Ramp::viridis,
     Layer::free_both},
    {Look::specificity, "specificity", "specificity = sum of m(A)/|A|", "S", Ramp::viridis, Layer::specificity},
    {Look::internal_conflict, "internal_conflict", "internal conflict = -sum of m log2 Pl", "bit", Ramp::oranges,
     Layer::internal_conflict},
    {Look::decision, "decision", "decided: m(unknown) < 1/2 and the larger mass", "", Ramp::rdbu, Layer::decision},
    {Look::decision_betp, "decision_betp", "decided: BetP at least 0.65 either way", "", Ramp::rdbu,
     Layer::decision_betp},
    {Look::fuzzy_map, "fuzzy_map", "fuzzy map M of the memberships e, o", "M", Ramp::rdbu, Layer::fuzzy_map},
    {Look::costmap, "costmap", "costs of costmap_2d from BetP", "cost", Ramp::viridis},
    {Look::mixed, "mixed", "masses mixed", "", {}},
    {Look::composite, "composite", "grey composite of the three beliefs", "", {}},
    {Look::panels, "panels", "three beliefs and their composite", "", {}},
    {Look::surface, "surface", "Bel(occupied) as a surface", "", {}, Layer::bel},
};

/// The least 1, 2 or 5 · 10^k that is not below x.
double round_up(double x) noexcept {
  double decade = std::pow(10, std::floor(std::log10(x)));
  for (const double step : {1.0, 2.0, 5.0, 10.0}) {
    if (step * decade >= x * (1 - 1e-9)) return step * decade;
  }
  return x;
}

}  // namespace

std::span<const LookRow> all_looks() noexcept { return kRows; }

const LookRow& row_of(Look look) noexcept {
  for (const LookRow& row : kRows) {
    if (row.look == look) return row;
  }
  return kRows[0];
}

std::string look_names() {
  std::string out;
  for (const LookRow& row : kRows) out += (out.empty() ? "" : ", ") + std::string(row.name);
  return out;
}

Look parse_look(const std::string& option, const std::string& wanted) {
  for (const LookRow& row : kRows) {
    if (row.name == wanted) return row.look;
  }
  throw InputError(fmt::format("{}: '{}' is unknown; known: {}", option, wanted, look_names()));
}

std::vector<Look> parse_looks(const std::string& option, const std::string& names) {
  std::vector<Look> out;
  if (names == "all") {
    for (const LookRow& row : kRows) out.push_back(row.look);
    return out;
  }
  for (std::size_t from = 0; from <= names.size() && !names.empty();) {
    const std::size_t comma = std::min(names.find(',', from), names.size());
    const Look look = parse_look(option, names.substr(from, comma - from));
    if (std::find(out.begin(), out.end(), look) == out.end()) out.push_back(look);
    from = comma + 1;
  }
  return out;
}

bool is_kept(Look look, const Layers& l) noexcept {
  return !(look == Look::con && l.con < 0) && !(look == Look::last_conflict && l.last_conflict < 0);
}

double value_of(Look look, const Layers& l, std::size_t i) noexcept {
  if (look == Look::conflict) return l.conflict()[i];
  if (look == Look::con) return l.optional(l.con, i);
  if (look == Look::last_conflict) return l.optional(l.last_conflict, i);
  if (look == Look::costmap) return cost_of(Costmap{}, l.mass(i));
  const LookRow& row = row_of(look);
  return row.layer ? evigrid::value_of(*row.layer, l.mass(i)) : 0;
}

bool never_seen(const Layers& l, std::size_t i) noexcept { return l.mass(i) == Mass{}; }

double top_of(Look look, const Layers& l) {
  if (look == Look::costmap) return 252;
  if (look != Look::conflict && look != Look::con) return 1;
  std::vector<float> seen;
  for (std::size_t i = 0; i < l.cells(); ++i) {
    const auto v = static_cast<float>(value_of(look, l, i));
    if (v > 0) seen.push_back(v);
  }
  if (seen.empty()) return 1;
  const auto at = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() - 1 - seen.size() / 100);
  std::nth_element(seen.begin(), at, seen.end());
  return round_up(std::max(static_cast<double>(*at), 0.01));
}

Rgb composite_grey(float e, float o, float u) noexcept {
  const double white = e + 0.5 * u, sum = static_cast<double>(e) + o + u;
  return colour_of(Ramp::greys, 1 - (sum > 0 ? white / sum : 0.5));
}

}  // namespace evigrid::driver
