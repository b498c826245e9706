// SPDX-License-Identifier: Apache-2.0
// How the map of a paper's run agrees with the true scene, as findings with floors and as a table. score/ says what
// each figure means.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "paper/finding.hpp"
#include "score/rerender.hpp"
#include "score/score.hpp"

namespace evigrid::driver {

/// What a sound map holds, within one cell of misplacement; stated beside the figures.
struct Floors {
  double precision = 0, recall = 0;  ///< at least
  double mistaken_rate = 1;          ///< at most
};

/// Precision, recall and mistaken rate of the map `which`, each against its floor.
[[nodiscard]] std::vector<Finding> agreement(const std::string& which, const Score& score, const Floors& floors);

struct ScoredMap {
  std::string name;
  Score score;
  double mean_conflict = 0;  ///< running sum of k, mean over the cells seen
  std::optional<Rerendered> rerendered{};
};
/// Every metric of every map: head and rows for Page::table.
struct MetricTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};
[[nodiscard]] MetricTable metric_table(const std::vector<ScoredMap>& maps);

/// Running sum of k, mean over the cells that some reading reached.
[[nodiscard]] double mean_conflict(const Layers& layers);

}  // namespace evigrid::driver
