// SPDX-License-Identifier: Apache-2.0
// One page over the runs of all papers: what was published, what came out, where to read on.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "paper/paper.hpp"

namespace evigrid::driver {

struct PaperRun {
  const Paper* paper = nullptr;
  std::vector<Finding> findings;
  double wall_s = 0;
};

struct Tally {
  std::size_t met = 0, missed = 0;    ///< published outcomes
  std::size_t floors = 0, below = 0;  ///< bounds of our own: all of them, and those that fail
  std::size_t others = 0;             ///< figures of which nothing is asked
};
[[nodiscard]] Tally tally(const std::vector<Finding>& findings);

/// Links lead to NAME/report.html.
[[nodiscard]] std::string index_page(const std::vector<PaperRun>& runs);
[[nodiscard]] nlohmann::ordered_json index_json(const std::vector<PaperRun>& runs);

}  // namespace evigrid::driver
