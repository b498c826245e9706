// SPDX-License-Identifier: Apache-2.0
#include "picture/look.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "error.hpp"

namespace evigrid::driver {
namespace {

constexpr LookRow kRows[] = {
    {Look::betp, "betp", "BetP(occupied) = m(occupied) + m(unknown)/2", "BetP", Ramp::rdbu},
    {Look::bel, "bel", "Bel(occupied) = m(occupied)", "Bel", Ramp::viridis},
    {Look::pl, "pl", "Pl(occupied) = m(occupied) + m(unknown)", "Pl", Ramp::viridis},
    {Look::empty, "empty", "m(empty)", "m", Ramp::viridis},
    {Look::unknown, "unknown", "m(unknown)", "m", Ramp::viridis},
    {Look::ignorance, "ignorance", "ignorance = Pl(occupied) - Bel(occupied)", "Pl-Bel", Ramp::viridis},
    {Look::entropy, "entropy", "entropy of BetP", "bit", Ramp::viridis},
    {Look::conflict, "conflict", "conflict met on the way: sum of k", "sum k", Ramp::oranges},
    {Look::costmap, "costmap", "costs of costmap_2d from BetP", "cost", Ramp::viridis},
    {Look::mixed, "mixed", "masses mixed", "", {}},
    {Look::composite, "composite", "grey composite of the three beliefs", "", {}},
    {Look::panels, "panels", "three beliefs and their composite", "", {}},
    {Look::surface, "surface", "Bel(occupied) as a surface", "", {}},
};

double entropy_bits(double p) noexcept {
  const auto part = [](double q) { return q > 0 ? -q * std::log2(q) : 0; };
  return part(p) + part(1 - p);
}

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

double value_of(Look look, const Layers& l, std::size_t i) noexcept {
  const double o = l.o()[i], u = l.u()[i];
  switch (look) {
    case Look::betp:
      return o + 0.5 * u;
    case Look::bel:
    case Look::surface:
      return o;
    case Look::pl:
      return o + u;
    case Look::empty:
      return l.e()[i];
    case Look::unknown:
    case Look::ignorance:  // Pl − Bel: the same for every rule that leaves no mass on the paradox
      return u;
    case Look::entropy:
      return entropy_bits(std::clamp(o + 0.5 * u, 0.0, 1.0));
    case Look::conflict:
      return l.conflict()[i];
    case Look::costmap:
      return cost_of(Costmap{}, {l.e()[i], l.o()[i], l.u()[i]});
    case Look::mixed:
    case Look::composite:
    case Look::panels:
      break;
  }
  return 0;
}

bool never_seen(const Layers& l, std::size_t i) noexcept { return l.u()[i] == 1 && l.e()[i] == 0 && l.o()[i] == 0; }

double top_of(Look look, const Layers& l) {
  if (look == Look::costmap) return 252;
  if (look != Look::conflict) return 1;
  std::vector<float> seen;
  for (std::size_t i = 0; i < l.cells(); ++i) {
    if (l.conflict()[i] > 0) seen.push_back(l.conflict()[i]);
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
