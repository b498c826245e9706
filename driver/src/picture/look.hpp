// SPDX-License-Identifier: Apache-2.0
// What a map can be shown as: one row a look, with the number that a cell gets, its range, its unit and its colours.
// `betp`, `bel` … are numbers with a colour bar; mixed, composite, panels and surface are pictures of their own.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "out/layers.hpp"
#include "picture/ramp.hpp"

namespace evigrid::driver {

enum class Look {
  betp,
  bel,
  pl,
  empty,
  unknown,
  ignorance,  ///< Pl − Bel: the width of the belief interval
  entropy,    ///< of BetP, bits
  conflict,
  con,            ///< this and the next only of maps that keep them
  last_conflict,
  paradox,        ///< m(∅), or of both at once
  commonality,
  plp,
  dsmp,
  free_betp,
  free_both,
  specificity,
  internal_conflict,
  decision,
  decision_betp,
  fuzzy_map,
  costmap,
  mixed,      ///< the masses mixed: map.png
  composite,  ///< one grey picture of the three masses, as Hughes & Murphy 1992 look at theirs
  panels,     ///< the three masses and the composite side by side
  surface     ///< bel(occupied) over x and y, as Li et al. 2006 show theirs
};

struct LookRow {
  Look look;
  std::string_view name, title;
  std::string_view unit;  ///< above the colour bar
  std::optional<Ramp> ramp;  ///< none: no number of a cell
  std::optional<Layer> layer{};  ///< of the engine, for its numbers
};
std::span<const LookRow> all_looks() noexcept;
const LookRow& row_of(Look) noexcept;

/// "betp,conflict" or "all". Throws InputError naming `option`, the bad name and the known ones.
std::vector<Look> parse_looks(const std::string& option, const std::string& names);
Look parse_look(const std::string& option, const std::string& name);
std::string look_names();

/// Whether the map that the layers came from keeps what the look shows.
bool is_kept(Look, const Layers&) noexcept;
/// Cell i of the layers as the look's number.
double value_of(Look, const Layers&, std::size_t i) noexcept;
/// No reading ever said anything about cell i.
bool never_seen(const Layers&, std::size_t i) noexcept;
/// Upper end of the colour bar: 1, but for conflict a round number above all but a hundredth of the cells seen, and
/// for costs 252. Values above it take its colour.
double top_of(Look, const Layers&);
/// Grey of the composite: white for empty, black for occupied, in proportion to the masses, unknown half.
Rgb composite_grey(float e, float o, float u) noexcept;

inline constexpr Rgb kNeverSeen{158, 158, 158};

}  // namespace evigrid::driver
