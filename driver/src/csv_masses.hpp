// SPDX-License-Identifier: Apache-2.0
// Masses of several sources from a CSV text: columns e1, o1, e2, o2 … and, where a source holds mass on empty ∩
// occupied, c1, c2 … by name in the head line, in any order.
#pragma once
#include <istream>
#include <string>
#include <vector>

namespace evigrid::driver {

struct SourceMasses {
  std::vector<double> e, o, c;  ///< c is empty where the file has no such column
};
struct MassRows {
  std::vector<SourceMasses> sources;
  [[nodiscard]] std::size_t rows() const { return sources.empty() ? 0 : sources[0].e.size(); }
};

inline constexpr int kMostSources = 64;

/// Every number is checked: within [0, 1] and e + o + c ≤ 1 (both with 1e-6 to spare for rounded files).
/// Throws InputError "name:line:column: ...".
MassRows read_masses(std::istream& in, const std::string& name, int sources = 2);

}  // namespace evigrid::driver
