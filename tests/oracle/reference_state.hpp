// SPDX-License-Identifier: Apache-2.0
// What the slow reference keeps under the rules whose state is not (e, o, u), in long double: each by a definition of
// its own and not by the engine's sums of logarithms.
#pragma once
#include <optional>

#include "evigrid/map.hpp"
#include "tests/oracle/reference_model.hpp"
#include "tests/oracle/set_rules.hpp"

namespace oracle {

using Long = long double;

struct StateNumbers {
  Belief<Long, 3> m{};  ///< masses or memberships; murphy: their sums
  Long readings = 0;    ///< murphy
  Long odds = 1;        ///< bayes: P(occupied) / P(empty)
  bool told = false;    ///< any reading yet
};

/// The masses to be read afterwards, and the conflict of the update.
struct StateAnswer {
  double e, o, u, c, conflict;
};

/// Nothing for the rules whose state is (e, o, u).
std::optional<StateAnswer> update_state(const evigrid::MapParams&, StateNumbers&, const Source&);

}  // namespace oracle
