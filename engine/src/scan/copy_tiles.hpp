// SPDX-License-Identifier: Apache-2.0
// Copy on write: before a batch is fused, the tiles that it reaches and a view may be reading are copied, in parallel.
#pragma once
#include "evigrid/executor.hpp"
#include "scan/bin.hpp"

namespace evigrid {

/// Those tiles go on in a copy. Throws std::length_error at the memory cap, before any cell is changed.
void copy_what_views_see(const Plan&, TileStore&, Executor&);

}  // namespace evigrid
