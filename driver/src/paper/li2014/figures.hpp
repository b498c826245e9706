// SPDX-License-Identifier: Apache-2.0
// The figures of Li et al. 2014 that need no drive: table 1 (PCR2 against PCR5), 50 000 groups in a cycle, table 2
// (readings against the truth), table 3 (gbbas on the axis).
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "paper/paper_world.hpp"

namespace evigrid::driver {

struct RuleComparison {
  std::size_t pairs = 0;
  double pcr2_ms = 0, pcr5_ms = 0;        ///< the fastest of several rounds in turns, one thread, in double, scalar
  double groups_ms = 0;                   ///< 50 000 groups by PCR2 in float, as a map's cells are, one thread
  std::array<double, 3> mean{};           ///< of PCR2 − PCR5 for e, o, u
  double mean_absolute = 0, largest = 0;  ///< of m(empty)
  double decide_otherwise = 0;            ///< share of pairs whose larger of e, o differs
};
/// Pairs uniform on the simplex of (e, o, u), by their seed.
[[nodiscard]] RuleComparison compare_rules(std::uint64_t seed, std::size_t pairs);

struct ErrorAtDistance {
  double distance_m = 0, mean_error_m = 0;
};
/// 20 readings of the scene's first sonar from a wall, every half metre up to 4 m.
[[nodiscard]] std::vector<ErrorAtDistance> errors_by_distance(const scenes::Scene& robot);

struct AxisRow {
  double reading_mm, distance_mm, e, o, c;  ///< as printed in table 3
};
[[nodiscard]] const std::array<AxisRow, 6>& table3() noexcept;
/// The same rows by the engine's model.
[[nodiscard]] std::array<AxisRow, 6> table3_ours();

}  // namespace evigrid::driver
