// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "paper/li2014/building.hpp"
#include "paper/paper.hpp"

namespace evigrid::driver {

/// The agents, and the potential field alone, drive from the start to every goal without knowing the plan.
void add_errands(PaperResult& out, const PaperOptions& options, const scenes::Scene& building,
                 const std::vector<Errand>& errands);

}  // namespace evigrid::driver
