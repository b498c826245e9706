// SPDX-License-Identifier: Apache-2.0
// The planes of a map's cells: those of its rule's state, then the history that the map keeps.
#pragma once
#include <string_view>
#include <vector>

#include "evigrid/map.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid {

struct Plane {
  std::string_view name;  // in files
  float vacuous;          // what a cell holds of which nothing was ever said
  float least, most;      // what a file may hold
  bool bits = false;      // any bits: half of a whole number, no quantity
};

inline constexpr int kMostMassPlanes = 4;         // e, o, u and c
inline constexpr int kMostForgettingPlanes = 10;  // the same, three of history, three of age

struct CellLayout {
  std::vector<Plane> planes;
  int state = 3;  // the first of them are the rule's, the others history
  int paradox = -1, conflict = -1, con = -1, last_conflict = -1;  // which plane; −1 is none
  int age = -1;                   // of maps that forget: the first of three planes (decay.hpp)
  bool planes_are_masses = true;  // the first three are e, o, u as they are read
  decltype(kernels::KernelTable::render_costs) render_costs = nullptr;  // where planes are masses, without c
  void (*read_out)(const float* cells, int planes, int micros, float* out) = nullptr;
};
CellLayout cell_layout(const MapParams&, const kernels::KernelTable&);
/// Names alone, also of files whose kernel cannot run here.
std::vector<Plane> planes_of(const MapParams&);
/// States that are masses can be discounted by time.
bool state_is_masses(Rule) noexcept;
/// States that are sums take a reading back exactly.
bool state_is_sum(Rule) noexcept;

}  // namespace evigrid
