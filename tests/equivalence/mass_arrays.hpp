// SPDX-License-Identifier: Apache-2.0
// Random masses as planes, a fifth of them certain.
#pragma once
#include <cstring>
#include <random>
#include <vector>

#include "evigrid/combine.hpp"

namespace evigrid::testing {

struct Arrays {
  std::vector<float> e, o, u;
  explicit Arrays(std::size_t n, unsigned seed) : e(n), o(n), u(n) {
    std::mt19937 rng(seed);
    std::uniform_real_distribution<float> r(0, 1);
    for (std::size_t i = 0; i < n; ++i) {
      e[i] = i % 5 == 0 ? static_cast<float>(i / 5 % 2) : r(rng);
      o[i] = i % 5 == 0 ? 1 - e[i] : r(rng) * (1 - e[i]);
      u[i] = 1 - e[i] - o[i];
    }
  }
  Planes<const float> in() const { return {e.data(), o.data(), u.data()}; }
  Planes<float> out() { return {e.data(), o.data(), u.data()}; }
  bool operator==(const Arrays& b) const {
    return e.empty() || (std::memcmp(e.data(), b.e.data(), e.size() * 4) == 0 &&
                         std::memcmp(o.data(), b.o.data(), o.size() * 4) == 0 &&
                         std::memcmp(u.data(), b.u.data(), u.size() * 4) == 0);
  }
};

}  // namespace evigrid::testing
