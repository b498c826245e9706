// SPDX-License-Identifier: Apache-2.0
// The largest number that still passes a test which larger numbers fail: doubling until one fails, then halving the
// gap.
#pragma once
#include <cstdint>
#include <functional>

namespace evigrid::driver {

struct FindMax {
  std::int64_t start = 1, most = 1;  ///< first try; never beyond
  double tolerance = 0;              ///< the answer may be this part of itself too small
};

/// 0 when 1 fails.
[[nodiscard]] std::int64_t find_max(const FindMax& search, const std::function<bool(std::int64_t)>& passes);

}  // namespace evigrid::driver
