// SPDX-License-Identifier: Apache-2.0
// Maps of several robots, or of several days, as one. Each call takes one map in, so n maps are taken in the order of
// the calls: the order is part of the result for rules that are not associative, as it is for readings.
#pragma once
#include <cstdint>

#include "evigrid/export.hpp"
#include "evigrid/map.hpp"
#include "evigrid/view.hpp"

namespace EVIGRID_API evigrid {

struct MergeOptions {
  Pose2 T_into_from{};     ///< takes coordinates of `from` to those of `into`; within 2^50 cells and 1e5 rad
  double reliability = 1;  ///< Shafer discount of all that `from` says, in (0, 1]
};

struct MergeReport {
  std::uint64_t cells = 0;            ///< of `into` that received something
  std::uint64_t total_conflicts = 0;  ///< answered by the rule's total-conflict policy
  float max_conflict = 0;             ///< largest k of one cell
  bool aligned = false;               ///< the pose was a shift by whole cells: every cell met exactly its own
};

/// Combines each cell of `into` with what `from` says there, by the rule of `into`: as the batched combine() does where
/// cells are masses; sums (dempster_log, murphy) are added, so that the result is the map of both logs to the bit when
/// both maps have that rule and reliability is 1; bayes adds log-odds, cautious takes the larger weight, fuzzy joins.
/// Maps that forget are joined as of now, the later of their last stamps: each says what it would say to a reader.
/// A pose without rotation that shifts by whole cells (to 1e-6 of a cell) is exact. Any other pose reads, for the
/// centre of each cell of `into`, the cell of `from` that it falls in: none is read between cells, and thin walls may
/// lose or double a cell. Sums of conflict add up, k of the merge among them. Areas outside the window of `into` are
/// left out; protected areas are merged into. `from` may have another rule: its masses are taken. Throws
/// std::invalid_argument for cells of another size, options outside their ranges, memberships (fuzzy) beside masses, or
/// masses that the rule of `into` cannot hold; std::length_error at the memory cap and std::system_error when a page
/// file cannot be written, before any cell is changed.
MergeReport merge(Map& into, const MapView& from, const MergeOptions& = {});

}  // namespace evigrid
