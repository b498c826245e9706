// SPDX-License-Identifier: Apache-2.0
// A sensor is declared once: its model with parameters, its mount, aperture, limits and reliability. A sonar is one
// cone; a laser scanner is one sensor with many beams. Ranges in brackets are what check() accepts; of the models'
// parameters it looks at those of the sensor's own model. "The book": Li, Huang & Dezert 2006 (docs/references.md).
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evigrid/export.hpp"
#include "evigrid/types.hpp"

namespace EVIGRID_API evigrid {

/// hughes1992 (Hughes & Murphy 1992). Distances are linear in (Rmax − d).
struct Hughes1992 {
  double r_max_m = 7.62;       ///< range at which belief has fallen to its angular part, [0.01, 1e4]
  double max_occupied = 0.98;  ///< largest m(occupied), [0, 1]
  double tolerance_m = 0.15;   ///< half width of the occupied arc, [1e-4, 10] (ours: the paper gives none)
};

/// oriolo1997 (Oriolo, Ulivi & Vendittelli 1997, as masses by Asharif et al. 2001).
struct Oriolo1997 {
  double k_empty = 0.1, k_occupied = 0.5;  ///< largest m(empty), m(occupied), [1e-6, 1] (Oriolo et al.)
  double delta_m = 0.15;                   ///< Δ: half width of the arc, [1e-3, 10] (ours, within the literature's)
  double rho_v_m = 1.2;                    ///< ρv: where readings are believed half, [0, 10] (ours, likewise)
};

/// li2006 (the book, eq. 14.6–14.10).
struct Li2006 {
  double rho_v = 1;         ///< ρv, 1/m²: sharpness of m(occupied), larger where there are few objects, [0.01, 100]
  double epsilon_m = 0.10;  ///< ε: range error, [0, 2] (ours)
  bool discount_by_lambda = true;  ///< divide by the sum, then discount by λ; false: as printed, λ cancels
};

/// probability (the book, eq. 14.11–14.13).
struct Probability {
  double epsilon_m = 0.10;  ///< ε: half width of the arc, [1e-3, 10] (ours)
  double rho_v_m = 1.2;     ///< ρv: where readings are believed half, [0, 10] (ours)
};

/// fuzzy (the book, eq. 14.15–14.16): memberships.
struct Fuzzy {
  double k_empty = 0.1, k_occupied = 0.5;  ///< largest memberships, [1e-6, 1]
  double epsilon_m = 0.10;                 ///< ε: half width of the arc, [1e-3, 10] (ours)
  double rho_v_m = 1.2;                    ///< ρv: where readings are believed half, [0, 10] (ours)
  bool as_printed = false;                 ///< the printed fΩ, occupied where it should be empty
};

/// moravec1985 (Moravec & Elfes 1985): memberships, that of occupied cancelled by that of empty.
struct Moravec1985 {
  double epsilon_m = 0.10;  ///< ε: half width of the arc, [1e-3, 10] (ours)
};

/// li2014 (Li, Huang, Wang, Dezert 2014, eq. 8–13). The paper's numbers: ρO is in √m, the others have no dimension.
struct Li2014 {
  double rho_e = 0.35;          ///< ρE: the Gaussian of empty about the sensor has the width ρE·R, [0.3, 1] (eq. 8)
  double rho_o = 0.1;           ///< ρO: the Gaussian of occupied about R has the width ρO·√R, [0.02, 1] (eq. 9)
  double rho_c = 80;            ///< ρC: sharpness of the paradox between the two, [80, 320] (eq. 10)
  double rho_i = 10;            ///< ρI: slope of unknown behind R, [1, 10] (eq. 11)
  double epsilon_ratio = 0.01;  ///< range error ε as a fraction of R, [1e-3, 0.01]
};

/// beam: laser range finder (ours).
struct Beam {
  double empty = 0.6, occupied = 0.8;   ///< masses at d = 0, [0, 1]; both fall linearly to half at max_range_m
  double empty_margin_m = 0.15;         ///< empty where d < R − this, [0, 10], at least occupied_half_width_m
  double occupied_half_width_m = 0.10;  ///< occupied where |d − R| ≤ this, [0, 10]
};

/// What several readings of one scan, of sensors with the same policy, are to one another where their cones overlap.
enum class Dependence : std::uint8_t {
  independent,    ///< distinct evidence: each meets the cell by the map's rule
  cautious,       ///< the same evidence, seen several times: the cautious rule (Denœux 2008) makes them one source
  once_per_scan,  ///< the first one, in the order of the scan, speaks for all
  weighted        ///< partly distinct: weights of evidence are multiplied by Sensor::weight_exponent, then added
};
std::string_view name(Dependence) noexcept;
std::optional<Dependence> dependence_from_name(std::string_view) noexcept;

struct RevisionNetwork;  // evigrid/revision.hpp

struct Sensor {
  Model model = Model::li2014;
  Pose2 T_robot_sensor{};           ///< mount, [−1e4, 1e4] m and [−1e3, 1e3] rad; a cone looks along its x axis
  double aperture_rad = 0.4363323;  ///< full opening of a cone (25°), [0.0087, 0.7]; unused by a fan
  /// Nearer readings are refused and nearer cells are left alone: [0, 1e4] m, li2006 and li2014 [1e-3, 1e4] (they
  /// divide by R), and below max_range_m.
  double min_range_m = 0.1;
  /// Cone: farther readings are refused. Fan: they clear up to it. [1e-3, 1e4] m, and at most 65 536 cells of the map.
  double max_range_m = 5.0;
  /// Readings from it on mean "no echo": refused, or cleared on request. [1e-3, 1e300] m.
  double no_return_m = 1000.0;
  bool clear_no_return = false;  ///< "no echo" clears up to max_range_m (fans only)
  double reliability = 1.0;      ///< Shafer discount of every reading, [1e-6, 1]
  /// Contextual discount before it, [1e-6, 1]: reliability where the cell is empty (what m(occupied) keeps), and where
  /// it is occupied (what m(empty) keeps).
  double reliability_if_empty = 1.0, reliability_if_occupied = 1.0;
  /// What this sensor says is forgotten with this τ, s, in maps that forget: 0, which means MapParams::decay_s, or
  /// [1e-3, 1e9]. A cell ages at the rate of the sensor that told it something last. Above 0 only where readings are
  /// independent.
  double decay_s = 0;
  /// In maps whose cells hold masses only. All but independent make the scan's readings one source a cell, which meets
  /// the cell after the scan's independent readings; mass on empty ∩ occupied is given up before.
  Dependence dependence = Dependence::independent;
  /// γ of weighted, [1e-3, 1]: 1 is Dempster's rule within the scan, 1/n the mean of n. 1 for the other policies.
  double weight_exponent = 1;
  /// A learned revision of what a model of masses says where it says anything, after the discounts, which it replaces:
  /// a trained sensor has a reliability of 1. In maps whose cells hold masses only, of cones; an unfused, slower path.
  /// Weights within ±RevisionNetwork::kMostWeight.
  std::shared_ptr<const RevisionNetwork> revision{};
  int beams = 1;              ///< number of ranges in one reading: 1 for a cone, [1, 100 000] for a fan
  double first_beam_rad = 0;  ///< of a fan: bearing of beam 0 in S, counter-clockwise, [−10, 10]
  double beam_step_rad = 0;   ///< of a fan: bearing from one beam to the next, [5e-4, 0.6]; times beams at most 2π
  Hughes1992 hughes{};
  Oriolo1997 oriolo{};
  Li2006 li2006{};
  Li2014 li{};
  Probability probability{};
  Fuzzy fuzzy{};
  Moravec1985 moravec{};
  Beam beam{};
};

using SensorId = std::uint32_t;

struct ParamError {
  std::string field;   ///< e.g. "sensor.aperture_rad"
  std::string reason;  ///< e.g. "is 0, must be within [0.0087, 0.7] rad"
};

/// Empty when the sensor is valid; every bad field otherwise.
[[nodiscard]] std::vector<ParamError> check(const Sensor&);

/// One parameter of a model, from the table that also checks it.
struct ModelParam {
  std::string_view name, unit;  ///< as in the model's struct, e.g. "epsilon_m", "m"
  double least, most, standard;
  bool is_switch;           ///< 0 or 1
  std::string_view source;  ///< the paper, or "ours"
};
[[nodiscard]] std::vector<ModelParam> model_params(Model);
/// nullopt when the model has no such parameter.
[[nodiscard]] std::optional<double> model_param(const Sensor&, Model, std::string_view name);
/// False when the model has no such parameter. Ranges are left to check().
bool set_model_param(Sensor&, Model, std::string_view name, double value);

/// Masses of one reading at one point of its cone or on its beam, from the same functions that the map runs.
struct ModelMass {
  double e = 0, o = 0, u = 1, c = 0;  ///< c = m(empty ∩ occupied), the paradoxical mass of li2006 and li2014
};
/// probability: e = 1 − P, o = P. fuzzy, moravec1985: e and o are memberships, u = (1 − e)(1 − o), c = e·o.
/// @param range_m reading; @param distance_m, theta_rad the point, from the sensor and off its axis.
/// @param cell_m side of the cells, above 0; only moravec1985, whose occupied membership is shared by the cells of the
/// arc, asks. Outside the support of the model the answer is vacuous. Throws std::invalid_argument for a bad sensor.
[[nodiscard]] ModelMass evaluate(const Sensor&, double range_m, double distance_m, double theta_rad,
                                 double cell_m = 0.01);

}  // namespace evigrid
