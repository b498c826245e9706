// SPDX-License-Identifier: Apache-2.0
#include "log/sensor_line.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <span>
#include <stdexcept>

#include "log/line_reader.hpp"

namespace evigrid::driver {
namespace {

/// By reference, of a const or a mutable sensor; the numbers of every model come from its table.
struct Field {
  const char* name;
  double& (*of)(Sensor&);
};
constexpr Field kFields[] = {
    {"x_m", [](Sensor& s) -> double& { return s.T_robot_sensor.x_m; }},
    {"y_m", [](Sensor& s) -> double& { return s.T_robot_sensor.y_m; }},
    {"yaw_rad", [](Sensor& s) -> double& { return s.T_robot_sensor.yaw_rad; }},
    {"aperture_rad", [](Sensor& s) -> double& { return s.aperture_rad; }},
    {"min_range_m", [](Sensor& s) -> double& { return s.min_range_m; }},
    {"max_range_m", [](Sensor& s) -> double& { return s.max_range_m; }},
    {"no_return_m", [](Sensor& s) -> double& { return s.no_return_m; }},
    {"reliability", [](Sensor& s) -> double& { return s.reliability; }},
    {"reliability_if_empty", [](Sensor& s) -> double& { return s.reliability_if_empty; }},
    {"reliability_if_occupied", [](Sensor& s) -> double& { return s.reliability_if_occupied; }},
    {"decay_s", [](Sensor& s) -> double& { return s.decay_s; }},
    {"weight_exponent", [](Sensor& s) -> double& { return s.weight_exponent; }},
    {"first_beam_rad", [](Sensor& s) -> double& { return s.first_beam_rad; }},
    {"beam_step_rad", [](Sensor& s) -> double& { return s.beam_step_rad; }},
};
constexpr std::string_view kMark = "sensor";
constexpr std::size_t kMostBeams = 100000;

[[noreturn]] void bad(std::string_view key, std::string_view why) {
  throw std::invalid_argument(fmt::format("{}: {}", printable(key), why));
}

/// @return false when no sensor has such a key.
bool set(LogSensor& to, std::string_view key, std::string_view text) {
  Sensor& s = to.sensor;
  if (key == "kind") return to.kind = printable(text), true;
  if (key == "name") return to.name = printable(text), true;
  if (key == "model") {
    const auto model = model_from_name(text);
    if (!model) bad(key, "no such model");
    return s.model = *model, true;
  }
  if (key == "dependence") {
    const auto dependence = dependence_from_name(text);
    if (!dependence) bad(key, "no such policy");
    return s.dependence = *dependence, true;
  }
  double value = 0;
  if (!parse_number(text, value) || !std::isfinite(value)) bad(key, "is no finite number");
  if (key == "beams") {
    if (!(value >= 1 && value <= kMostBeams) || value != std::floor(value)) bad(key, "is no number of beams");
    return s.beams = static_cast<int>(value), true;
  }
  if (key == "clear_no_return") return s.clear_no_return = value != 0, true;
  for (const Field& field : kFields) {
    if (key == field.name) return field.of(s) = value, true;
  }
  return set_model_param(s, s.model, key, value);  // model= stands before its numbers
}

}  // namespace

std::string sensor_line(std::size_t index, const LogSensor& sensor) {
  Sensor s = sensor.sensor;
  std::string out = fmt::format("# {} {} kind={}", kMark, index, sensor.kind);
  if (!sensor.name.empty() && sensor.name.find_first_of(" \t=") == std::string::npos) out += " name=" + sensor.name;
  out += fmt::format(" model={} beams={} dependence={} clear_no_return={}", name(s.model), s.beams, name(s.dependence),
                     s.clear_no_return ? 1 : 0);
  for (const Field& field : kFields) out += fmt::format(" {}={}", field.name, field.of(s));
  for (const ModelParam& p : model_params(s.model))
    out += fmt::format(" {}={}", p.name, *model_param(s, s.model, p.name));
  return out;
}

std::optional<LogSensor> parse_sensor_line(std::string_view line, std::size_t expected_index) {
  std::vector<std::string_view> words;
  split(line, words, 256);
  if (words.size() < 3 || words[0] != "#" || words[1] != kMark) return std::nullopt;
  double index = 0;
  if (!parse_number(words[2], index) || index != static_cast<double>(expected_index))
    bad(kMark, fmt::format("is number '{}', must be {}", printable(words[2].substr(0, 24)), expected_index));
  LogSensor out{"sensor", {}, {}, true};
  std::set<std::string_view> seen;
  for (const std::string_view word : std::span(words).subspan(3)) {
    const std::size_t equals = word.find('=');
    const std::string_view key = word.substr(0, std::min<std::size_t>(equals, 32));
    if (equals == std::string_view::npos) bad(key, "must be KEY=VALUE");
    if (!seen.insert(key).second) bad(key, "is given twice");
    if (!set(out, key, word.substr(equals + 1))) bad(key, "is no key of such a sensor");
  }
  return out;
}

}  // namespace evigrid::driver
