// SPDX-License-Identifier: Apache-2.0
// Every number a user can set: field, unit, range, source.
#pragma once
#include <string_view>
#include <type_traits>
#include <utility>

#include "evigrid/map.hpp"

namespace evigrid {

template <class T>
struct ParamRow {
  std::string_view field, unit;
  double least, most;
  double (*get)(const T&);
  std::string_view source;
  void (*set)(T&, double) = nullptr;
  bool is_switch = false;
};

inline constexpr double kLeastDecay_s = 1e-3, kMostDecay_s = 1e9;
inline constexpr double kMaxReachCells = 65536;  // the lattice of docs/maths.md keeps 2^-5 cells there

inline constexpr ParamRow<MapParams> kMapRows[] = {
    {"map.cell_m", "m", 1e-4, 100, [](const MapParams& p) { return p.cell_m; }, "ours"},
    {"map.bayes.least_p", "", 1e-9, 0.5, [](const MapParams& p) { return p.bayes.least_p; }, "ours"},
    {"map.bayes.most_p", "", 0.5, 1 - 1e-9, [](const MapParams& p) { return p.bayes.most_p; }, "ours"},
    {"map.false_reflection_m", "m (below 0: off)", 0, 1e3,
     [](const MapParams& p) { return p.false_reflection_m < 0 ? 0 : p.false_reflection_m; }, "Li et al. 2014"},
    {"map.decay_s", "s (0: never)", kLeastDecay_s, kMostDecay_s,
     [](const MapParams& p) { return p.decay_s == 0 ? kMostDecay_s : p.decay_s; }, "Shafer 1976, by time"},
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
    {"sensor.decay_s", "s (0: the map's)", kLeastDecay_s, kMostDecay_s,
     [](const Sensor& s) { return s.decay_s == 0 ? kMostDecay_s : s.decay_s; }, "ours"},
    {"sensor.weight_exponent", "", 1e-3, 1, [](const Sensor& s) { return s.weight_exponent; }, "Denœux 2008"},
    {"sensor.T_robot_sensor.x_m", "m", -1e4, 1e4, [](const Sensor& s) { return s.T_robot_sensor.x_m; }, "ours"},
    {"sensor.T_robot_sensor.y_m", "m", -1e4, 1e4, [](const Sensor& s) { return s.T_robot_sensor.y_m; }, "ours"},
    {"sensor.T_robot_sensor.yaw_rad", "rad", -1e3, 1e3, [](const Sensor& s) { return s.T_robot_sensor.yaw_rad; },
     "ours"},
};

/// A number of a model: member `Part` of the sensor, `Field` of it.
template <auto Part, auto Field>
constexpr ParamRow<Sensor> row(std::string_view field, std::string_view unit, double least, double most,
                               std::string_view source) {
  using Number = std::remove_cvref_t<decltype((std::declval<Sensor&>().*Part).*Field)>;
  return {field,
          unit,
          least,
          most,
          [](const Sensor& s) { return static_cast<double>((s.*Part).*Field); },
          source,
          [](Sensor& s, double v) { (s.*Part).*Field = static_cast<Number>(v); },
          std::is_same_v<Number, bool>};
}

inline constexpr std::string_view kChapter = "Li, Huang & Dezert 2006", kOriolo = "Oriolo et al. 1997", kOurs = "ours";

inline constexpr auto kHughes = &Sensor::hughes;
inline constexpr ParamRow<Sensor> kHughesRows[] = {
    row<kHughes, &Hughes1992::r_max_m>("sensor.hughes.r_max_m", "m", 1e-2, 1e4, "Hughes & Murphy 1992"),
    row<kHughes, &Hughes1992::max_occupied>("sensor.hughes.max_occupied", "", 0, 1, "Hughes & Murphy 1992"),
    row<kHughes, &Hughes1992::tolerance_m>("sensor.hughes.tolerance_m", "m", 1e-4, 10, kOurs),
};

// Beyond these ranges of the widths and of ρv the float distances would no longer give masses within 2e-6.
inline constexpr auto kOrioloPart = &Sensor::oriolo;
inline constexpr ParamRow<Sensor> kOrioloRows[] = {
    row<kOrioloPart, &Oriolo1997::k_empty>("sensor.oriolo.k_empty", "", 1e-6, 1, kOriolo),
    row<kOrioloPart, &Oriolo1997::k_occupied>("sensor.oriolo.k_occupied", "", 1e-6, 1, kOriolo),
    row<kOrioloPart, &Oriolo1997::delta_m>("sensor.oriolo.delta_m", "m", 1e-3, 10, kOurs),
    row<kOrioloPart, &Oriolo1997::rho_v_m>("sensor.oriolo.rho_v_m", "m", 0, 10, kOurs),
};

inline constexpr auto kLi2006 = &Sensor::li2006;
inline constexpr ParamRow<Sensor> kLi2006Rows[] = {
    row<kLi2006, &Li2006::rho_v>("sensor.li2006.rho_v", "1/m²", 0.01, 100, "Li, Huang & Dezert 2006, eq. 14.7"),
    row<kLi2006, &Li2006::epsilon_m>("sensor.li2006.epsilon_m", "m", 0, 2, kOurs),
    row<kLi2006, &Li2006::discount_by_lambda>("sensor.li2006.discount_by_lambda", "", 0, 1, kOurs),
};

inline constexpr auto kProbability = &Sensor::probability;
inline constexpr ParamRow<Sensor> kProbabilityRows[] = {
    row<kProbability, &Probability::epsilon_m>("sensor.probability.epsilon_m", "m", 1e-3, 10, kOurs),
    row<kProbability, &Probability::rho_v_m>("sensor.probability.rho_v_m", "m", 0, 10, kOurs),
};

inline constexpr auto kFuzzy = &Sensor::fuzzy;
inline constexpr ParamRow<Sensor> kFuzzyRows[] = {
    row<kFuzzy, &Fuzzy::k_empty>("sensor.fuzzy.k_empty", "", 1e-6, 1, kChapter),
    row<kFuzzy, &Fuzzy::k_occupied>("sensor.fuzzy.k_occupied", "", 1e-6, 1, kChapter),
    row<kFuzzy, &Fuzzy::epsilon_m>("sensor.fuzzy.epsilon_m", "m", 1e-3, 10, kOurs),
    row<kFuzzy, &Fuzzy::rho_v_m>("sensor.fuzzy.rho_v_m", "m", 0, 10, kOurs),
    row<kFuzzy, &Fuzzy::as_printed>("sensor.fuzzy.as_printed", "", 0, 1, "Li, Huang & Dezert 2006, eq. 14.16"),
};

inline constexpr auto kMoravec = &Sensor::moravec;
inline constexpr ParamRow<Sensor> kMoravecRows[] = {
    row<kMoravec, &Moravec1985::epsilon_m>("sensor.moravec.epsilon_m", "m", 1e-3, 10, kOurs),
};

// The fitted parts of the kernel hold their error inside these ranges.
inline constexpr auto kLi = &Sensor::li;
inline constexpr ParamRow<Sensor> kLiRows[] = {
    row<kLi, &Li2014::rho_e>("sensor.li.rho_e", "", 0.3, 1, "Li et al. 2014, eq. 8"),
    row<kLi, &Li2014::rho_o>("sensor.li.rho_o", "", 0.02, 1, "Li et al. 2014, eq. 9"),
    row<kLi, &Li2014::rho_c>("sensor.li.rho_c", "", 80, 320, "Li et al. 2014, eq. 10"),
    row<kLi, &Li2014::rho_i>("sensor.li.rho_i", "", 1, 10, "Li et al. 2014, eq. 11"),
    row<kLi, &Li2014::epsilon_ratio>("sensor.li.epsilon_ratio", "", 1e-3, 0.01, "Li et al. 2014"),
};

/// li2006 and li2014 divide by R.
inline constexpr ParamRow<Sensor> kPositiveRangeRows[] = {
    {"sensor.min_range_m", "m (the model needs R > 0)", 1e-3, 1e4, [](const Sensor& s) { return s.min_range_m; },
     "Li et al. 2014"},
};

inline constexpr ParamRow<Sensor> kFanRows[] = {
    {"sensor.beams", "", 1, 100000, [](const Sensor& s) { return static_cast<double>(s.beams); }, kOurs},
    {"sensor.beam_step_rad", "rad", 5e-4, 0.6, [](const Sensor& s) { return s.beam_step_rad; }, kOurs},
    {"sensor.first_beam_rad", "rad", -10, 10, [](const Sensor& s) { return s.first_beam_rad; }, kOurs},
};

inline constexpr auto kBeam = &Sensor::beam;
inline constexpr ParamRow<Sensor> kBeamRows[] = {
    row<kBeam, &Beam::empty>("sensor.beam.empty", "", 0, 1, kOurs),
    row<kBeam, &Beam::occupied>("sensor.beam.occupied", "", 0, 1, kOurs),
    row<kBeam, &Beam::empty_margin_m>("sensor.beam.empty_margin_m", "m", 0, 10, kOurs),
    row<kBeam, &Beam::occupied_half_width_m>("sensor.beam.occupied_half_width_m", "m", 0, 10, kOurs),
};

/// Empty when the map's rule can take what the sensor's model says.
std::vector<ParamError> check_pair(Rule, const Sensor&);
std::vector<ParamError> check_reach(const Sensor&, double cell_m);
/// "field reason; field reason".
std::string describe(const std::vector<ParamError>&);

}  // namespace evigrid
