// SPDX-License-Identifier: Apache-2.0
// Cells written without a sensor: the state that a rule keeps of a mass said by hand, and of two maps joined. The state
// of a mass M is that of a cell of which nothing was known before it was told M (kernels/cell/state.hpp, in double).
#pragma once
#include "evigrid/map.hpp"
#include "grid/cell_layout.hpp"

namespace evigrid {

inline constexpr int kMostStatePlanes = 8;

/// Planes of the state alone (no history), one float each.
struct CellPlanes {
  float at[kMostStatePlanes] = {};
};
CellPlanes state_of(const MapParams&, const Mass&) noexcept;

/// Of rules whose cells are not masses: what two cells are together. Sums add up exactly, larger weights stay, log-odds
/// add up within their limits, memberships join by the algebraic sum.
CellPlanes joined(const MapParams&, const CellPlanes&, const CellPlanes&) noexcept;

/// Empty for a mass that a cell of the rule can hold, else what is wrong.
std::string_view why_no_mass(Rule, const Mass&) noexcept;

/// −ln(1 − k), what an update adds to the plane `con`: of total conflict 27.6, as the kernels have it.
[[nodiscard]] float weight_of_conflict(float k) noexcept;

}  // namespace evigrid
