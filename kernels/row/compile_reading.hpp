// SPDX-License-Identifier: Apache-2.0
// From a sensor and a reading in metres to what the kernels see: the quantisation of docs/maths.md. What depends on the
// sensor alone is fitted once (ConeType, FanType).
#pragma once
#include <cstdint>
#include <vector>

#include "kernels/row/reading.hpp"

namespace evigrid::kernels {

/// Plain numbers of one sensor; metres and radians.
struct ConeSpec {
  int model = kLi2014;  // a ConeModel
  double cell_m, aperture_rad, min_range_m, max_range_m, reliability;
  double r_max_m, max_occupied, tolerance_m;                              // hughes1992
  double rho_e, rho_o, rho_c, rho_i, epsilon_ratio;                       // li2014
  double reliability_if_empty = 1, reliability_if_occupied = 1;
  double width_m = 0.15, rho_v_m = 1.2, k_empty = 0.1, k_occupied = 0.5;  // oriolo1997, fuzzy, probability
  bool as_printed = false;                                                // fuzzy
  double li2006_rho_v = 1, li2006_epsilon_m = 0.1;
  bool discount_by_lambda = true;  // li2006
  double moravec_epsilon_m = 0.1;
};

struct ConeType {
  ConeSpec spec{};
  double lattice = 65536;  // steps per cell
  double aperture_cos, aperture_sin;
  float lambda[4], shell[4], margin[4], off_axis[4];
  explicit ConeType(const ConeSpec&);
};

/// The farthest distance at which a reading says something, and the model's own edge.
struct ConeLimits {
  double outer, edge;
  double within = -1;  // nearer than it every cell lies before the model's own ring; negative: the model knows no zones
};
/// In metres and unrounded; compile_cone puts the same on the lattice.
ConeLimits cone_limits_m(const ConeSpec&, double range_m) noexcept;

struct FanSpec {
  double cell_m, min_range_m, max_range_m, reliability;
  int beams;
  double first_beam_rad, beam_step_rad;
  double empty, occupied, empty_margin_m, half_width_m;
  double reliability_if_empty = 1, reliability_if_occupied = 1;
};

/// What all fans of a sensor share: the borders between its beams as directions in the sensor's frame.
struct FanType {
  FanSpec spec{};
  double lattice = 65536;
  bool full_circle = false;
  std::vector<double> border_cos, border_sin;  // beams + 1
  double mid_cos = 1, mid_sin = 0;
  explicit FanType(const FanSpec&);
};

/// A fan, compiled by a table (kernel_table.hpp), and the arrays it points into; move-only in effect (copies would point at the original's arrays).
struct Fan {
  FanReading reading;
  std::vector<float> range;  // metres, one a beam: negative when refused, above max_range_m clears up to it
  std::vector<float> cells;  // the same as the kernels read it, between two pads
  std::vector<float> border_x, border_y;
  std::vector<std::uint32_t> reach;
  double x_min, x_max, y_min, y_max;  // box of what it can touch, cells from the apex
};

struct SensorPose {
  double x_m, y_m, yaw_rad;  // frame of the map
};

/// Steps per cell so that offsets up to `reach_cells` keep 22 bits.
double lattice_steps(double reach_cells) noexcept;

ConeReading compile_cone(const ConeType&, const SensorPose&, double range_m) noexcept;

}  // namespace evigrid::kernels
