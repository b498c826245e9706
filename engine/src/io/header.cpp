// SPDX-License-Identifier: Apache-2.0
// One list of fields writes and reads: shortest decimal text that gives back the same bits (std::to_chars).
#include "io/header.hpp"

#include <array>
#include <charconv>
#include <stdexcept>
#include <type_traits>

#include "evigrid/revision.hpp"
#include "grid/rect.hpp"

namespace evigrid::io {
namespace {

constexpr std::string_view kSensor = "[sensor]";

template <class P, class F>
void each_param(P& p, F&& f) {
  f("cell_m", p.cell_m);
  f("rule", p.rule);
  f("kernel", p.kernel);
  f("keep_conflict", p.keep_conflict);
  f("keep_con", p.keep_con);
  f("keep_last_conflict", p.keep_last_conflict);
  f("bayes.likelihood", p.bayes.likelihood);
  f("bayes.least_p", p.bayes.least_p);
  f("bayes.most_p", p.bayes.most_p);
  f("memory_cap_bytes", p.memory_cap_bytes);
  f("false_reflection_m", p.false_reflection_m);
  f("decay_s", p.decay_s);
}

template <class S, class F>
void each_field(S& s, F&& f) {
  f("model", s.model);
  f("T_robot_sensor.x_m", s.T_robot_sensor.x_m);
  f("T_robot_sensor.y_m", s.T_robot_sensor.y_m);
  f("T_robot_sensor.yaw_rad", s.T_robot_sensor.yaw_rad);
  f("aperture_rad", s.aperture_rad);
  f("min_range_m", s.min_range_m);
  f("max_range_m", s.max_range_m);
  f("no_return_m", s.no_return_m);
  f("clear_no_return", s.clear_no_return);
  f("reliability", s.reliability);
  f("reliability_if_empty", s.reliability_if_empty);
  f("reliability_if_occupied", s.reliability_if_occupied);
  f("decay_s", s.decay_s);
  f("dependence", s.dependence);
  f("weight_exponent", s.weight_exponent);
  f("beams", s.beams);
  f("first_beam_rad", s.first_beam_rad);
  f("beam_step_rad", s.beam_step_rad);
  f("hughes.r_max_m", s.hughes.r_max_m);
  f("hughes.max_occupied", s.hughes.max_occupied);
  f("hughes.tolerance_m", s.hughes.tolerance_m);
  f("oriolo.k_empty", s.oriolo.k_empty);
  f("oriolo.k_occupied", s.oriolo.k_occupied);
  f("oriolo.delta_m", s.oriolo.delta_m);
  f("oriolo.rho_v_m", s.oriolo.rho_v_m);
  f("li2006.rho_v", s.li2006.rho_v);
  f("li2006.epsilon_m", s.li2006.epsilon_m);
  f("li2006.discount_by_lambda", s.li2006.discount_by_lambda);
  f("probability.epsilon_m", s.probability.epsilon_m);
  f("probability.rho_v_m", s.probability.rho_v_m);
  f("fuzzy.k_empty", s.fuzzy.k_empty);
  f("fuzzy.k_occupied", s.fuzzy.k_occupied);
  f("fuzzy.epsilon_m", s.fuzzy.epsilon_m);
  f("fuzzy.rho_v_m", s.fuzzy.rho_v_m);
  f("fuzzy.as_printed", s.fuzzy.as_printed);
  f("moravec.epsilon_m", s.moravec.epsilon_m);
  f("li.rho_e", s.li.rho_e);
  f("li.rho_o", s.li.rho_o);
  f("li.rho_c", s.li.rho_c);
  f("li.rho_i", s.li.rho_i);
  f("li.epsilon_ratio", s.li.epsilon_ratio);
  f("beam.empty", s.beam.empty);
  f("beam.occupied", s.beam.occupied);
  f("beam.empty_margin_m", s.beam.empty_margin_m);
  f("beam.occupied_half_width_m", s.beam.occupied_half_width_m);
}

/// What is neither a parameter nor a sensor, but for last_stamp_ns, window, protected areas and planes, which need not
/// be there, and map_hash, which is hexadecimal as in every report.
template <class I, class F>
void each_fact(I& i, F&& f) {
  f("maths_version", i.maths_version);
}

template <class T>
void write(std::string& out, std::string_view key, const T& value) {
  out.append(key).push_back('=');
  if constexpr (std::is_same_v<T, bool>) {
    out += value ? '1' : '0';
  } else if constexpr (std::is_enum_v<T>) {
    out += name(value);
  } else {
    std::array<char, 40> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    out.append(text.data(), end);
  }
  out += '\n';
}

std::optional<Rule> from_name(Rule, std::string_view s) { return rule_from_name(s); }
std::optional<Model> from_name(Model, std::string_view s) { return model_from_name(s); }
std::optional<Likelihood> from_name(Likelihood, std::string_view s) { return likelihood_from_name(s); }
std::optional<Dependence> from_name(Dependence, std::string_view s) { return dependence_from_name(s); }
std::optional<Kernel> from_name(Kernel, std::string_view s) { return kernel_from_name(s); }

template <class T>
bool read(std::string_view text, T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    value = text == "1";
    return text == "1" || text == "0";
  } else if constexpr (std::is_enum_v<T>) {
    const auto found = from_name(value, text);
    if (found) value = *found;
    return found.has_value();
  } else {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
  }
}

void write_revision(std::string& out, const RevisionNetwork& network) {
  out += "revision=";
  std::array<char, 40> text;
  for (std::size_t i = 0; i < network.weight.size(); ++i) {
    const auto end = std::to_chars(text.data(), text.data() + text.size(), network.weight[i]).ptr;
    out.append(i > 0 ? "," : "").append(text.data(), end);
  }
  out += '\n';
}

bool read_revision(std::string_view list, std::shared_ptr<const RevisionNetwork>& into) {
  auto network = std::make_shared<RevisionNetwork>();
  for (std::size_t i = 0; i < network->weight.size(); ++i) {
    const std::size_t comma = list.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == network->weight.size())) return false;
    if (!read(list.substr(0, comma), network->weight[i])) return false;
    list = comma == std::string_view::npos ? std::string_view{} : list.substr(comma + 1);
  }
  into = std::move(network);
  return true;
}

void write(std::string& out, std::string_view key, const CellRect& r) {
  out.append(key).push_back('=');
  for (const std::int64_t n : {r.x, r.y, r.width, r.height}) out.append(std::to_string(n)).push_back(',');
  out.back() = '\n';
}

/// Four numbers; a rectangle that a map may be asked with, and not empty.
bool read(std::string_view list, CellRect& r) {
  for (std::int64_t* const n : {&r.x, &r.y, &r.width, &r.height}) {
    const std::size_t comma = list.find(',');
    if ((comma == std::string_view::npos) != (n == &r.height) || !read(list.substr(0, comma), *n)) return false;
    list.remove_prefix(comma == std::string_view::npos ? list.size() : comma + 1);
  }
  return !r.empty() && is_near(r);
}

std::vector<std::string> split(std::string_view list) {
  std::vector<std::string> out;
  while (!list.empty()) {
    const std::size_t comma = list.find(',');
    out.emplace_back(list.substr(0, comma));
    list = comma == std::string_view::npos ? std::string_view{} : list.substr(comma + 1);
  }
  return out;
}

}  // namespace

std::string header_text(const MapFileInfo& info) {
  std::string out;
  const auto line = [&](std::string_view key, const auto& value) { write(out, key, value); };
  each_fact(info, line);
  constexpr std::string_view kDigits = "0123456789abcdef";  // all 16 digits, as everywhere else
  out.append("map_hash=");
  for (int bits = 60; bits >= 0; bits -= 4) out.push_back(kDigits[(info.hash >> bits) & 15]);
  out.push_back('\n');
  if (info.last_stamp_ns) line("last_stamp_ns", *info.last_stamp_ns);
  if (info.window) write(out, "window", *info.window);
  for (const CellRect& area : info.protected_areas) write(out, "protected", area);
  out += "planes=";
  for (std::size_t i = 0; i < info.planes.size(); ++i) out += (i > 0 ? "," : "") + info.planes[i];
  out += '\n';
  each_param(info.params, line);
  for (const Sensor& sensor : info.sensors) {
    out.append(kSensor).push_back('\n');
    each_field(sensor, line);
    if (sensor.revision) write_revision(out, *sensor.revision);
  }
  return out;
}

MapFileInfo parse_header(std::string_view text) {
  MapFileInfo info;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) throw std::invalid_argument("header: its last line has no end");
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    if (line == kSensor) {
      info.sensors.emplace_back();
      continue;
    }
    const std::size_t equals = line.find('=');
    const std::string_view key = line.substr(0, equals);
    const std::string_view value = equals == std::string_view::npos ? std::string_view{} : line.substr(equals + 1);
    bool known = false, good = false;
    const auto match = [&](std::string_view field, auto& target) {
      if (field != key) return;
      known = true;
      good = read(value, target);
    };
    if (!info.sensors.empty() && key == "revision") {
      known = true;
      good = read_revision(value, info.sensors.back().revision);
    } else if (!info.sensors.empty()) {
      each_field(info.sensors.back(), match);
    } else if (key == "planes") {
      info.planes = split(value);
      known = good = true;
    } else if (key == "map_hash") {
      known = true;
      good =
          std::from_chars(value.data(), value.data() + value.size(), info.hash, 16).ptr == value.data() + value.size();
    } else if (key == "last_stamp_ns") {
      match(key, info.last_stamp_ns.emplace());
    } else if (key == "window") {
      match(key, info.window.emplace());
    } else if (key == "protected") {
      match(key, info.protected_areas.emplace_back());
    } else {
      each_fact(info, match);
      each_param(info.params, match);
    }
    const std::string where = "header line " + std::to_string(number) + ": '" + std::string(key) + "' ";
    if (!known) throw std::invalid_argument(where + "is unknown: a newer program wrote this file");
    if (!good) throw std::invalid_argument(where + "has the bad value '" + std::string(value) + "'");
  }
  return info;
}

}  // namespace evigrid::io
