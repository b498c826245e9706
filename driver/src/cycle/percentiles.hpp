// SPDX-License-Identifier: Apache-2.0
// Percentiles by nearest rank: p of n values is the ⌈p·n/100⌉-th smallest, always one of them. p99 of 100 values is the
// second largest: one may be above.
#pragma once
#include <cstddef>
#include <vector>

namespace evigrid::driver {

struct Spread {
  double p50 = 0, p95 = 0, p99 = 0, max = 0, mean = 0;
};

/// All 0 for no values.
[[nodiscard]] Spread spread_of(std::vector<double> values);
/// How many of n values may lie above their p-th percentile's limit.
[[nodiscard]] std::size_t allowed_above(int percent, std::size_t n);

}  // namespace evigrid::driver
