// SPDX-License-Identifier: Apache-2.0
// How two maps of one place differ, cell by cell over the smallest box around both. A cell that one map never saw is
// vacuous there, as its masses say.
#pragma once
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "out/layers.hpp"
#include "picture/sheet.hpp"

namespace evigrid::driver {

/// Of one mass (or BetP) over the cells that at least one map has seen.
struct Deviation {
  double mean = 0;      ///< of B − A
  double mean_abs = 0;  ///< of |B − A|
  double rms = 0;
  double largest = 0;  ///< of |B − A|
  CellIndex at{};      ///< the first cell, row by row, where it is reached
};

struct MapDifference {
  CellRect rect{};                                      ///< around both, in cells
  std::uint64_t seen_a = 0, seen_b = 0, seen_both = 0;  ///< cells that hold a non-vacuous mass
  std::uint64_t same_bits = 0;                          ///< cells seen by both whose e, o and u are equal bit for bit
  Deviation empty, occupied, unknown, betp;
  /// [A][B] by Decision (unknown, empty, occupied; Li et al. 2014), over the cells seen by at least one.
  std::array<std::array<std::uint64_t, 3>, 3> decisions{};
  double agreement = 0;   ///< of the cells that both decide: share decided alike; NaN when there is none
  double contradict = 0;  ///< of the same cells: share empty in one and occupied in the other

  [[nodiscard]] bool same() const { return seen_a == seen_b && same_bits == seen_a; }
};

/// Smallest box around both; an empty one counts for nothing.
[[nodiscard]] CellRect box_around(const CellRect& a, const CellRect& b);

/// Both rendered over one rectangle. Throws std::invalid_argument when they are not.
[[nodiscard]] MapDifference difference(const Layers& a, const Layers& b);
[[nodiscard]] nlohmann::ordered_json to_json(const MapDifference& difference);

/// BetP of B less that of A: red where B is surer of occupied, blue where A is, near white where they agree, grey where
/// neither has seen anything. A pixel of several cells shows its largest difference.
[[nodiscard]] Thumbnail difference_thumbnail(const Layers& a, const Layers& b, const SheetScale& scale);

}  // namespace evigrid::driver
