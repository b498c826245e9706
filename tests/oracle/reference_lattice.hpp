// SPDX-License-Identifier: Apache-2.0
// How the reference puts a reading on its lattice: steps, apex and directions. On the lattice every decision
// "is this centre inside?" is exact in double.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "evigrid/sensor.hpp"

namespace oracle {

/// Lattice of one sensor: 2^-p cells.
class Lattice {
 public:
  Lattice() = default;
  explicit Lattice(double reach_cells)
      : p_(std::min(16, 22 - static_cast<int>(std::ceil(std::log2(reach_cells + 8))))) {}
  [[nodiscard]] double round(double cells) const { return std::ldexp(std::nearbyint(std::ldexp(cells, p_)), -p_); }
  [[nodiscard]] double step() const { return std::ldexp(1.0, -p_); }
  [[nodiscard]] int bits() const { return p_; }

 private:
  int p_ = 16;
};

/// One coordinate of the apex: the cell below or at it, and how far it lies beyond that cell's centre, in cells.
struct ApexCoordinate {
  std::int64_t cell = 0;
  double offset = 0;
};
inline ApexCoordinate apex_coordinate(const Lattice& lattice, double position_m, double cell_m) {
  const double cells = position_m / cell_m - 0.5;
  const double below = std::floor(cells);
  return {static_cast<std::int64_t>(below), lattice.round(cells - below)};
}

/// A direction with float components; nearly aligned ones are exactly aligned.
struct Direction {
  double x = 1, y = 0;
};
inline Direction direction(double angle_rad) {
  Direction d{static_cast<float>(std::cos(angle_rad)), static_cast<float>(std::sin(angle_rad))};
  if (std::fabs(d.x) < 1e-7) d = {0, d.y < 0 ? -1.0 : 1.0};
  if (std::fabs(d.y) < 1e-7) d = {d.x < 0 ? -1.0 : 1.0, 0};
  return d;
}

/// Of a cone's edge: components that are multiples of 2^-24.
inline Direction edge_direction(double angle_rad) {
  const Direction d = direction(angle_rad);
  return {std::ldexp(std::nearbyint(std::ldexp(d.x, 24)), -24), std::ldexp(std::nearbyint(std::ldexp(d.y, 24)), -24)};
}

/// a × b. Exact: 24-bit directions times lattice offsets of at most 22 bits and a bit.
inline double cross(double ax, double ay, double bx, double by) { return ax * by - ay * bx; }

/// Half the arc of a model that has one, metres.
inline double arc_m(const evigrid::Sensor& s) {
  switch (s.model) {
    case evigrid::Model::oriolo1997:
      return s.oriolo.delta_m;
    case evigrid::Model::li2006:
      return s.li2006.epsilon_m;
    case evigrid::Model::probability:
      return s.probability.epsilon_m;
    case evigrid::Model::fuzzy:
      return s.fuzzy.epsilon_m;
    case evigrid::Model::moravec1985:
      return s.moravec.epsilon_m;
    default:
      return 0;
  }
}

/// What sets the lattice: the largest reading and the width of the model's arc, in cells.
inline double reach_cells(const evigrid::Sensor& s, double cell_m) {
  if (s.model == evigrid::Model::hughes1992) return (s.max_range_m + s.hughes.tolerance_m) / cell_m;
  if (s.model == evigrid::Model::li2014) return s.max_range_m * (1 + 2 * s.li.epsilon_ratio) / cell_m;
  return (s.max_range_m + arc_m(s)) / cell_m;
}

}  // namespace oracle
