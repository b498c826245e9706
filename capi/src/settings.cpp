// SPDX-License-Identifier: Apache-2.0
// Settings by name. What a value may be is checked where it is used, by the engine's parameter table; here is checked
// that it can be stored at all.
#include <cmath>
#include <string>
#include <string_view>

#include "handles.hpp"

using namespace evigrid;
using capi::guarded, capi::need;

namespace {

template <class T>
struct Number {
  std::string_view name;
  void (*set)(T&, double);
};

std::size_t bytes_of(double v) {
  if (!(v >= 0 && v <= 0x1p62)) throw std::invalid_argument("memory_cap_bytes must be within [0, 2^62]");
  return static_cast<std::size_t>(v);
}
int count_of(std::string_view name, double v) {
  if (!(v >= 0 && v <= 1e6) || v != std::floor(v)) {
    throw std::invalid_argument(std::string(name) + " must be a whole number within [0, 10^6]");
  }
  return static_cast<int>(v);
}
bool flag_of(double v) {
  if (v != 0 && v != 1) throw std::invalid_argument("a switch must be 0 or 1");
  return v == 1;
}

constexpr Number<evigrid_params> kParams[] = {
    {"cell_m", [](evigrid_params& p, double v) { p.map.cell_m = v; }},
    {"keep_conflict", [](evigrid_params& p, double v) { p.map.keep_conflict = flag_of(v); }},
    {"keep_con", [](evigrid_params& p, double v) { p.map.keep_con = flag_of(v); }},
    {"keep_last_conflict", [](evigrid_params& p, double v) { p.map.keep_last_conflict = flag_of(v); }},
    {"memory_cap_bytes", [](evigrid_params& p, double v) { p.map.memory_cap_bytes = bytes_of(v), p.cap_asked = true; }},
    {"false_reflection_m", [](evigrid_params& p, double v) { p.map.false_reflection_m = v; }},
    {"decay_s", [](evigrid_params& p, double v) { p.map.decay_s = v; }},
    {"bayes.least_p", [](evigrid_params& p, double v) { p.map.bayes.least_p = v; }},
    {"bayes.most_p", [](evigrid_params& p, double v) { p.map.bayes.most_p = v; }},
    {"threads", [](evigrid_params& p, double v) { p.threads = count_of("threads", v); }},
};

constexpr Number<Sensor> kSensor[] = {
    {"x_m", [](Sensor& s, double v) { s.T_robot_sensor.x_m = v; }},
    {"y_m", [](Sensor& s, double v) { s.T_robot_sensor.y_m = v; }},
    {"yaw_rad", [](Sensor& s, double v) { s.T_robot_sensor.yaw_rad = v; }},
    {"aperture_rad", [](Sensor& s, double v) { s.aperture_rad = v; }},
    {"min_range_m", [](Sensor& s, double v) { s.min_range_m = v; }},
    {"max_range_m", [](Sensor& s, double v) { s.max_range_m = v; }},
    {"no_return_m", [](Sensor& s, double v) { s.no_return_m = v; }},
    {"clear_no_return", [](Sensor& s, double v) { s.clear_no_return = flag_of(v); }},
    {"reliability", [](Sensor& s, double v) { s.reliability = v; }},
    {"reliability_if_empty", [](Sensor& s, double v) { s.reliability_if_empty = v; }},
    {"reliability_if_occupied", [](Sensor& s, double v) { s.reliability_if_occupied = v; }},
    {"decay_s", [](Sensor& s, double v) { s.decay_s = v; }},
    {"weight_exponent", [](Sensor& s, double v) { s.weight_exponent = v; }},
    {"beams", [](Sensor& s, double v) { s.beams = count_of("beams", v); }},
    {"first_beam_rad", [](Sensor& s, double v) { s.first_beam_rad = v; }},
    {"beam_step_rad", [](Sensor& s, double v) { s.beam_step_rad = v; }},
};

template <class T, std::size_t N>
bool set(const Number<T> (&numbers)[N], T& of, std::string_view name, double value) {
  for (const auto& n : numbers) {
    if (n.name == name) return n.set(of, value), true;
  }
  return false;
}

std::invalid_argument unknown(const char* what, std::string_view name) {
  return std::invalid_argument(std::string(what) + " has no setting \"" + std::string(name) + "\"");
}
template <class T>
T named(std::optional<T> found, std::string_view what, const char* value) {
  if (!found) throw std::invalid_argument("no " + std::string(what) + " is called \"" + value + "\"");
  return *found;
}

}  // namespace

evigrid_status evigrid_params_create(evigrid_params** out) {
  return guarded([&] { need(out, "out") = new evigrid_params; });
}
void evigrid_params_destroy(evigrid_params* params) { delete params; }

evigrid_status evigrid_params_set_number(evigrid_params* params, const char* name, double value) {
  return guarded([&] {
    need(name, "name");
    if (!set(kParams, need(params, "params"), name, value)) throw unknown("a map", name);
  });
}

evigrid_status evigrid_params_set_text(evigrid_params* params, const char* name, const char* value) {
  return guarded([&] {
    auto& p = need(params, "params");
    const std::string_view field(&need(name, "name"));
    need(value, "value");
    if (field == "rule") {
      p.map.rule = named(rule_from_name(value), field, value);
    } else if (field == "kernel") {
      p.map.kernel = named(kernel_from_name(value), field, value);
      p.kernel_asked = true;
    } else if (field == "bayes.likelihood") {
      p.map.bayes.likelihood = named(likelihood_from_name(value), field, value);
    } else if (field == "executor") {
      const std::string_view text(value);
      if (text != "tbb" && text != "openmp" && text != "spin" && text != "serial") {
        throw std::invalid_argument("no executor is called \"" + std::string(text) + "\"");
      }
      p.executor = text;
    } else {
      throw unknown("a map", field);
    }
  });
}

evigrid_status evigrid_sensor_create(const char* model, evigrid_sensor** out) {
  return guarded([&] {
    need(model, "model");
    need(out, "out");
    auto made = std::make_unique<evigrid_sensor>();
    made->sensor.model = named(model_from_name(model), "model", model);
    *out = made.release();
  });
}
void evigrid_sensor_destroy(evigrid_sensor* sensor) { delete sensor; }

evigrid_status evigrid_sensor_set_number(evigrid_sensor* sensor, const char* name, double value) {
  return guarded([&] {
    Sensor& s = need(sensor, "sensor").sensor;
    need(name, "name");
    if (!set(kSensor, s, name, value) && !set_model_param(s, s.model, name, value)) {
      throw unknown(("a sensor of the model " + std::string(evigrid::name(s.model))).c_str(), name);
    }
  });
}

evigrid_status evigrid_sensor_set_text(evigrid_sensor* sensor, const char* name, const char* value) {
  return guarded([&] {
    Sensor& s = need(sensor, "sensor").sensor;
    need(value, "value");
    if (std::string_view(&need(name, "name")) != "dependence") throw unknown("a sensor", name);
    s.dependence = named(dependence_from_name(value), "dependence", value);
  });
}

evigrid_status evigrid_sensor_evaluate(const evigrid_sensor* sensor, double range_m, double distance_m,
                                       double theta_rad, evigrid_mass* mass) {
  return guarded([&] {
    need(mass, "mass");
    const ModelMass m = evaluate(need(sensor, "sensor").sensor, range_m, distance_m, theta_rad);
    *mass = {static_cast<float>(m.e), static_cast<float>(m.o), static_cast<float>(m.u), static_cast<float>(m.c)};
  });
}
