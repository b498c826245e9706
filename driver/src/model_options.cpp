// SPDX-License-Identifier: Apache-2.0
#include "model_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"
#include "log/line_reader.hpp"
#include "options.hpp"

namespace evigrid::driver {
namespace {

constexpr double kTolerance_m = 0.1;  // ours: the paper calls it predefined

std::string names_of(Model model) {
  std::string out;
  for (const ModelParam& p : model_params(model)) out += (out.empty() ? "" : ", ") + std::string(p.name);
  return out;
}

double parse_value(const std::string& text, std::string_view value, bool is_switch) {
  if (is_switch && (value == "true" || value == "false")) return value == "true" ? 1 : 0;
  double number = 0;
  if (!parse_number(value, number) || (is_switch && number != 0 && number != 1)) {
    throw InputError(fmt::format("--param: '{}' is not {}", text,
                                 is_switch ? "MODEL.NAME=true or MODEL.NAME=false" : "MODEL.NAME=number"));
  }
  return number;
}

}  // namespace

std::vector<ModelSetting> parse_settings(const std::vector<std::string>& texts, std::optional<Model> implied) {
  std::vector<ModelSetting> out;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) throw InputError(fmt::format("--param: '{}' is not MODEL.NAME=VALUE", text));
    std::string key = text.substr(0, equals);
    const std::size_t dot = key.find('.');
    if (dot == std::string::npos && !implied) {
      throw InputError(fmt::format("--param: '{}' does not name its model: MODEL.NAME=VALUE", text));
    }
    const Model model = dot == std::string::npos ? *implied : parse_model(key.substr(0, dot));
    if (dot != std::string::npos) key = key.substr(dot + 1);
    const auto all = model_params(model);
    const auto found = std::find_if(all.begin(), all.end(), [&](const ModelParam& p) { return p.name == key; });
    if (found == all.end()) {
      throw InputError(fmt::format("--param: {} has no parameter '{}'; it has: {}", name(model), key, names_of(model)));
    }
    const double value = parse_value(text, std::string_view(text).substr(equals + 1), found->is_switch);
    if (!(value >= found->least && value <= found->most)) {
      throw InputError(fmt::format("--param: {}.{} is {:g}, must be within [{:g}, {:g}] {}", name(model), key, value,
                                   found->least, found->most, found->unit));
    }
    out.push_back({model, key, value});
  }
  return out;
}

void apply_settings(const std::vector<ModelSetting>& settings, Sensor& sensor) {
  for (const ModelSetting& s : settings) {
    if (s.model == sensor.model) set_model_param(sensor, s.model, s.name, s.value);
  }
}

void require_used(const std::vector<ModelSetting>& settings, const std::vector<std::string>& used) {
  for (const ModelSetting& s : settings) {
    if (std::find(used.begin(), used.end(), name(s.model)) == used.end()) {
      throw InputError(fmt::format("--param: {}.{}: no sensor here has that model", name(s.model), s.name));
    }
  }
}

double parse_filter(const std::string& text) {
  constexpr std::string_view kName = "false_reflection";
  if (text.empty() || text == "none") return -1;
  double tolerance_m = kTolerance_m;
  const std::string_view rest = text.starts_with(kName) ? std::string_view(text).substr(kName.size()) : "?";
  const bool good = rest.empty() || (rest.front() == '=' && parse_number(rest.substr(1), tolerance_m));
  if (!good || !(tolerance_m >= 0 && tolerance_m <= 1000)) {
    throw InputError(fmt::format("--filter: '{}' is none of: false_reflection, false_reflection=METRES, none", text));
  }
  return tolerance_m;
}

void apply_dependence(const std::string& text, Sensor& sensor) {
  if (text.empty()) return;
  const std::size_t equals = text.find('=');
  const auto policy = dependence_from_name(std::string_view(text).substr(0, equals));
  double exponent = 1;
  const bool number = equals != std::string::npos && parse_number(std::string_view(text).substr(equals + 1), exponent);
  if (!policy || number != (policy == Dependence::weighted) || (!number && equals != std::string::npos)) {
    throw InputError(
        fmt::format("--dependence: '{}' is none of: independent, cautious, once_per_scan, weighted=EXPONENT", text));
  }
  sensor.dependence = *policy;
  sensor.weight_exponent = exponent;
}

std::string describe_model_params() {
  std::string out = "Parameters of the models (--param MODEL.NAME=VALUE):\n";
  for (const Model model : all_models()) {
    for (const ModelParam& p : model_params(model)) {
      out += fmt::format("  {:<36}{:<6}[{:g}, {:g}], default {:g}  ({})\n", fmt::format("{}.{}", name(model), p.name),
                         p.unit, p.least, p.most, p.standard, p.source);
    }
  }
  return out;
}

}  // namespace evigrid::driver
