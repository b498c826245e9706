// SPDX-License-Identifier: Apache-2.0
#include "cycle/percentiles.hpp"

#include <algorithm>
#include <numeric>

namespace evigrid::driver {

std::size_t allowed_above(int percent, std::size_t n) {
  const std::size_t rank = (static_cast<std::size_t>(percent) * n + 99) / 100;
  return n - rank;
}

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](int percent) { return values[values.size() - 1 - allowed_above(percent, values.size())]; };
  return {at(50), at(95), at(99), values.back(),
          std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size())};
}

}  // namespace evigrid::driver
