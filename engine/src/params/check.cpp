// SPDX-License-Identifier: Apache-2.0
// The parameter table: every number of a sensor and a map with its unit, range and source. One row validates, and its
// text is what the error says.
#include <cmath>
#include <cstdio>
#include <span>

#include "evigrid/map.hpp"
#include "evigrid/revision.hpp"
#include "grid/cell_layout.hpp"
#include "model_rows.hpp"
#include "params/table.hpp"

namespace evigrid {
namespace {

std::string number(double v) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", v);
  return text;
}

template <class T>
void check_rows(std::span<const ParamRow<T>> rows, const T& of, std::vector<ParamError>& errors) {
  for (const auto& row : rows) {
    const double v = row.get(of);
    if (!(v >= row.least && v <= row.most)) {
      errors.push_back({std::string(row.field), "is " + number(v) + ", must be within [" + number(row.least) + ", " +
                                                    number(row.most) + "]" + (row.unit.empty() ? "" : " ") +
                                                    std::string(row.unit)});
    }
  }
}

}  // namespace

std::vector<ParamError> check(const Sensor& s) {
  std::vector<ParamError> errors;
  check_rows<Sensor>(kSensorRows, s, errors);
  if (s.min_range_m >= s.max_range_m) errors.push_back({"sensor.min_range_m", "must be below max_range_m"});
  if (s.model == Model::li2006 || s.model == Model::li2014) check_rows<Sensor>(kPositiveRangeRows, s, errors);
  if (s.model == Model::beam) check_rows<Sensor>(kFanRows, s, errors);
  check_rows<Sensor>(model_row(s.model).params, s, errors);
  if (s.model == Model::beam) {
    if (s.beam.empty_margin_m < s.beam.occupied_half_width_m) {
      errors.push_back({"sensor.beam.empty_margin_m", "must be at least occupied_half_width_m"});
    }
    if (s.beams * s.beam_step_rad > 6.2831854) {
      errors.push_back({"sensor.beam_step_rad", "times beams is more than a full circle"});
    }
  }
  if (s.dependence != Dependence::independent && s.decay_s > 0) {
    errors.push_back({"sensor.decay_s", "cannot be beside dependence " + std::string(name(s.dependence)) +
                                            ": what several sensors say together is forgotten at the map's rate"});
  }
  if (s.dependence != Dependence::weighted && s.weight_exponent != 1) {
    errors.push_back({"sensor.weight_exponent", "is of the dependence weighted alone"});
  }
  if (s.revision) {
    if (s.model == Model::beam || model_row(s.model).says != Says::masses)
      errors.push_back({"sensor.revision", "is for cones of masses, not for " + std::string(name(s.model))});
    for (const double w : s.revision->weight) {
      if (std::fabs(w) <= RevisionNetwork::kMostWeight) continue;
      errors.push_back({"sensor.revision", "has the weight " + number(w) + ", must be within ±1e100"});
      break;
    }
  }
  if (s.model != Model::beam && s.beams != 1) errors.push_back({"sensor.beams", "must be 1 for a cone"});
  return errors;
}

std::vector<ParamError> check(const MapParams& p) {
  std::vector<ParamError> errors;
  check_rows<MapParams>(kMapRows, p, errors);
  if (!(p.bayes.least_p < p.bayes.most_p)) errors.push_back({"map.bayes.least_p", "must be below most_p"});
  if (p.keep_con && !p.keep_conflict) errors.push_back({"map.keep_con", "needs keep_conflict"});
  if (p.keep_last_conflict && !p.keep_conflict) errors.push_back({"map.keep_last_conflict", "needs keep_conflict"});
  if (p.decay_s > 0 && !state_is_masses(p.rule)) {
    errors.push_back({"map.decay_s", "cannot be with the rule " + std::string(name(p.rule)) +
                                         ": its cells hold no masses that time could discount"});
  }
  if (const auto why = why_not_in_maps(p.rule); !why.empty()) {
    errors.push_back(
        {"map.rule", "cannot be " + std::string(name(p.rule)) + ": " + std::string(why) + "; use it with combine"});
  }
  return errors;
}

std::vector<ParamError> check_pair(Rule rule, const Sensor& s) {
  const std::string_view why = why_not_together(rule, s.model);
  if (why.empty() && s.dependence != Dependence::independent && !state_is_masses(rule)) {
    return {{"sensor.dependence", std::string(name(s.dependence)) + " cannot be with the rule " +
                                      std::string(name(rule)) + ": its cells hold no masses"}};
  }
  if (why.empty() && s.revision && !state_is_masses(rule)) {
    return {{"sensor.revision", "cannot be with the rule " + std::string(name(rule)) + ": its cells hold no masses"}};
  }
  if (why.empty()) return {};
  return {{"sensor.model",
           std::string(name(s.model)) + " cannot be fused by " + std::string(name(rule)) + ": " + std::string(why)}};
}

std::vector<ParamError> check_reach(const Sensor& s, double cell_m) {
  const double cells = s.max_range_m / cell_m;
  if (cells <= kMaxReachCells) return {};
  return {{"sensor.max_range_m", "is " + number(cells) + " cells of " + number(cell_m) + " m; at most " +
                                     number(kMaxReachCells) + " are supported"}};
}

std::string describe(const std::vector<ParamError>& errors) {
  std::string text;
  for (const auto& e : errors) text += (text.empty() ? "" : "; ") + e.field + " " + e.reason;
  return text;
}

}  // namespace evigrid
