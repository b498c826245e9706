// SPDX-License-Identifier: Apache-2.0
// The parts of the report on Li et al. 2014: each adds its findings, its section of the page and its pictures.
#pragma once
#include <cmath>
#include <numbers>

#include "paper/paper.hpp"
#include "paper/paper_world.hpp"

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
/// @param world the paper's room, or a part of a building, with a person and up to two things, which are its boxes.
void add_dynamic_room(PaperResult& out, const PaperOptions& options, const PaperWorld& world);
/// @param world with the wheels that slip or drift.
void add_heading(PaperResult& out, const PaperOptions& options, const PaperWorld& world);
void add_trap(PaperResult& out, const PaperOptions& options);

/// The whole report of a user's building: what of the paper makes sense there, and what is left out.
[[nodiscard]] PaperResult li2014_in_building(const PaperOptions& options);

}  // namespace evigrid::driver
