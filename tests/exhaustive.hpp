// SPDX-License-Identifier: Apache-2.0
// EVIGRID_EXHAUSTIVE=1: the whole domain where tests look at a part of it, which takes minutes a test.
#pragma once
#include <cstdlib>

namespace evigrid::tests {

inline bool exhaustive() { return std::getenv("EVIGRID_EXHAUSTIVE") != nullptr; }

}  // namespace evigrid::tests
