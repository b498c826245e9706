// SPDX-License-Identifier: Apache-2.0
// Parameters of sensor models and filters of readings, as the command line writes them.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "evigrid/sensor.hpp"

namespace evigrid::driver {

/// One --param MODEL.NAME=VALUE.
struct ModelSetting {
  Model model;
  std::string name;
  double value;
};

/// Throws InputError. `implied`: the model of a bare NAME=VALUE.
std::vector<ModelSetting> parse_settings(const std::vector<std::string>& texts, std::optional<Model> implied = {});
/// Those of the sensor's own model.
void apply_settings(const std::vector<ModelSetting>& settings, Sensor& sensor);
/// Throws InputError for a setting of a model that is not among `used`: it would be ignored.
void require_used(const std::vector<ModelSetting>& settings, const std::vector<std::string>& used);

/// --filter: the tolerance of false_reflection, below 0 for none. Throws InputError.
double parse_filter(const std::string& text);
/// --dependence: NAME, or weighted=EXPONENT. Empty leaves the sensor as it is.
void apply_dependence(const std::string& text, Sensor& sensor);

/// For --help: every model's parameters with unit, range and default.
std::string describe_model_params();

}  // namespace evigrid::driver
