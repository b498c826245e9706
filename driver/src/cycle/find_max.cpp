// SPDX-License-Identifier: Apache-2.0
#include "cycle/find_max.hpp"

#include <algorithm>

namespace evigrid::driver {

std::int64_t find_max(const FindMax& search, const std::function<bool(std::int64_t)>& passes) {
  std::int64_t good = 0, bad = search.most + 1;
  for (std::int64_t n = std::clamp<std::int64_t>(search.start, 1, search.most); bad > search.most;) {
    if (!passes(n)) {
      bad = n;
    } else {
      good = n;
      if (n == search.most) return n;
      n = n > search.most / 2 ? search.most : 2 * n;
    }
  }
  const auto near_enough = [&] {
    return bad - good <= 1 || static_cast<double>(bad - good) <= search.tolerance * static_cast<double>(good);
  };
  while (!near_enough()) {
    // Nothing passed yet: the start was far too large, and small fleets are tried sooner by quarters.
    const std::int64_t n = good == 0 ? std::max<std::int64_t>(bad / 4, 1) : good + (bad - good) / 2;
    (passes(n) ? good : bad) = n;
  }
  return good;
}

}  // namespace evigrid::driver
