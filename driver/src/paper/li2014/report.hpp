// SPDX-License-Identifier: Apache-2.0
// The parts of the report on Li et al. 2014: each adds its findings, its section of the page and its pictures.
#pragma once
#include <cmath>
#include <numbers>

#include "paper/paper.hpp"

namespace evigrid::driver {

inline constexpr double kCycle_ms = 100;
inline constexpr double kDegree = std::numbers::pi / 180;
[[nodiscard]] inline double ratio(std::size_t a, std::size_t b) {
  return b == 0 ? 0 : static_cast<double>(a) / static_cast<double>(b);
}

/// Tables 1 to 3, and 50 000 groups in a cycle.
void add_tables(PaperResult& out, const PaperOptions& options);
/// Table 3's learned revision.
void add_revision(PaperResult& out, const PaperOptions& options);
void add_dynamic_room(PaperResult& out, const PaperOptions& options);
void add_heading(PaperResult& out, const PaperOptions& options);
void add_trap(PaperResult& out, const PaperOptions& options);

}  // namespace evigrid::driver
