// SPDX-License-Identifier: Apache-2.0
// One row for each way of fusing: what it was, what it cost, how good it is where the truth is known.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "score/flips.hpp"
#include "score/rerender.hpp"
#include "score/score.hpp"

namespace evigrid::driver {

struct CompareRow {
  std::string robot, rule, model;
  double cell_m = 0;  ///< side of a cell
  std::uint64_t cells_updated = 0, readings_used = 0, readings_refused = 0, total_conflicts = 0;
  double fusion_s = 0;
  double mean_conflict = 0;  ///< running sum of k a touched cell
  double ignorance = 0;      ///< mean m(unknown) of the map's box
  Rerendered rerendered;     ///< the readings against those that the map predicts
  int flips = 0;             ///< of the rule: readings_to_flip
  std::string map_hash;
  std::optional<Score> score;
};

[[nodiscard]] std::string to_csv(const std::vector<CompareRow>& rows);
[[nodiscard]] std::string to_markdown(const std::vector<CompareRow>& rows);
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<CompareRow>& rows);

}  // namespace evigrid::driver
