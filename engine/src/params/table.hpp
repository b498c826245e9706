// SPDX-License-Identifier: Apache-2.0
// Every number a user can set: field, unit, range, source.
#pragma once
#include <string_view>

#include "evigrid/map.hpp"

namespace evigrid {

template <class T>
struct ParamRow {
  std::string_view field, unit;
  double least, most;
  double (*get)(const T&);
  std::string_view source;
};

inline constexpr double kMaxReachCells = 65536;  // the lattice of docs/maths.md keeps 2^-5 cells there

inline constexpr ParamRow<MapParams> kMapRows[] = {
    {"map.cell_m", "m", 1e-4, 100, [](const MapParams& p) { return p.cell_m; }, "ours"},
    {"map.bayes.least_p", "", 1e-9, 0.5, [](const MapParams& p) { return p.bayes.least_p; }, "ours"},
    {"map.bayes.most_p", "", 0.5, 1 - 1e-9, [](const MapParams& p) { return p.bayes.most_p; }, "ours"},
};

// Apertures above 40° would need a higher degree than the cubic fits of the cone's angular part have.
inline constexpr ParamRow<Sensor> kSensorRows[] = {
    {"sensor.aperture_rad", "rad", 0.0087, 0.7,
     [](const Sensor& s) { return s.model == Model::beam ? 0.1 : s.aperture_rad; }, "ours"},
    {"sensor.min_range_m", "m", 0, 1e4, [](const Sensor& s) { return s.min_range_m; }, "ours"},
    {"sensor.max_range_m", "m", 1e-3, 1e4, [](const Sensor& s) { return s.max_range_m; }, "ours"},
    {"sensor.no_return_m", "m", 1e-3, 1e300, [](const Sensor& s) { return s.no_return_m; }, "ours"},
    {"sensor.reliability", "", 1e-6, 1, [](const Sensor& s) { return s.reliability; }, "Shafer 1976"},
    {"sensor.reliability_if_empty", "", 1e-6, 1, [](const Sensor& s) { return s.reliability_if_empty; },
     "Mercier et al. 2008"},
    {"sensor.reliability_if_occupied", "", 1e-6, 1, [](const Sensor& s) { return s.reliability_if_occupied; },
     "Mercier et al. 2008"},
    {"sensor.T_robot_sensor.x_m", "m", -1e4, 1e4, [](const Sensor& s) { return s.T_robot_sensor.x_m; }, "ours"},
    {"sensor.T_robot_sensor.y_m", "m", -1e4, 1e4, [](const Sensor& s) { return s.T_robot_sensor.y_m; }, "ours"},
    {"sensor.T_robot_sensor.yaw_rad", "rad", -1e3, 1e3, [](const Sensor& s) { return s.T_robot_sensor.yaw_rad; },
     "ours"},
};

inline constexpr ParamRow<Sensor> kHughesRows[] = {
    {"sensor.hughes.r_max_m", "m", 1e-2, 1e4, [](const Sensor& s) { return s.hughes.r_max_m; }, "Hughes & Murphy 1992"},
    {"sensor.hughes.max_occupied", "", 0, 1, [](const Sensor& s) { return s.hughes.max_occupied; },
     "Hughes & Murphy 1992"},
    {"sensor.hughes.tolerance_m", "m", 1e-4, 10, [](const Sensor& s) { return s.hughes.tolerance_m; }, "ours"},
};

// The fitted parts of the kernel hold their error inside these ranges.
inline constexpr ParamRow<Sensor> kLiRows[] = {
    {"sensor.min_range_m", "m (li2014 needs R > 0)", 1e-3, 1e4, [](const Sensor& s) { return s.min_range_m; },
     "Li et al. 2014"},
    {"sensor.li.rho_e", "", 0.3, 1, [](const Sensor& s) { return s.li.rho_e; }, "Li et al. 2014, eq. 8"},
    {"sensor.li.rho_o", "", 0.02, 1, [](const Sensor& s) { return s.li.rho_o; }, "Li et al. 2014, eq. 9"},
    {"sensor.li.rho_c", "", 80, 320, [](const Sensor& s) { return s.li.rho_c; }, "Li et al. 2014, eq. 10"},
    {"sensor.li.rho_i", "", 1, 10, [](const Sensor& s) { return s.li.rho_i; }, "Li et al. 2014, eq. 11"},
    {"sensor.li.epsilon_ratio", "", 1e-3, 0.01, [](const Sensor& s) { return s.li.epsilon_ratio; }, "Li et al. 2014"},
};

inline constexpr ParamRow<Sensor> kBeamRows[] = {
    {"sensor.beams", "", 1, 100000, [](const Sensor& s) { return static_cast<double>(s.beams); }, "ours"},
    {"sensor.beam_step_rad", "rad", 5e-4, 0.6, [](const Sensor& s) { return s.beam_step_rad; }, "ours"},
    {"sensor.first_beam_rad", "rad", -10, 10, [](const Sensor& s) { return s.first_beam_rad; }, "ours"},
    {"sensor.beam.empty", "", 0, 1, [](const Sensor& s) { return s.beam.empty; }, "ours"},
    {"sensor.beam.occupied", "", 0, 1, [](const Sensor& s) { return s.beam.occupied; }, "ours"},
    {"sensor.beam.empty_margin_m", "m", 0, 10, [](const Sensor& s) { return s.beam.empty_margin_m; }, "ours"},
    {"sensor.beam.occupied_half_width_m", "m", 0, 10, [](const Sensor& s) { return s.beam.occupied_half_width_m; },
     "ours"},
};

std::vector<ParamError> check_reach(const Sensor&, double cell_m);
/// "field reason; field reason".
std::string describe(const std::vector<ParamError>&);

}  // namespace evigrid
