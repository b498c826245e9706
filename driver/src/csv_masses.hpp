// SPDX-License-Identifier: Apache-2.0
// Pairs of masses from a CSV text: columns e1, o1, e2, o2 by name in the head line, in any order.
#pragma once
#include <array>
#include <istream>
#include <string>
#include <vector>

namespace evigrid::driver {

struct MassPairs {
  std::array<std::vector<double>, 4> columns;  ///< e1, o1, e2, o2
  [[nodiscard]] std::size_t rows() const { return columns[0].size(); }
};

/// Every number is checked: within [0, 1] and e + o ≤ 1 (both with 1e-6 to spare for rounded files).
/// Throws InputError "name:line:column: ...".
MassPairs read_mass_pairs(std::istream& in, const std::string& name);

}  // namespace evigrid::driver
