// SPDX-License-Identifier: Apache-2.0
#include "bind.hpp"

namespace evigrid::python {
namespace {

void set(Sensor& s, const std::string& name, const py::handle& value) {
  py::object self = py::cast(&s, py::return_value_policy::reference);
  if (py::hasattr(self, name.c_str()) && name != "model") {
    py::setattr(self, name.c_str(), value);
  } else if (!set_model_param(s, s.model, name, value.cast<double>())) {
    throw std::invalid_argument("a sensor of the model " + std::string(evigrid::name(s.model)) + " has no setting \"" +
                                name + "\"");
  }
}

Sensor make(const std::string& model, const py::kwargs& settings) {
  Sensor s;
  s.model = named(model_from_name(model), "model", model);
  for (const auto& [key, value] : settings) set(s, key.cast<std::string>(), value);
  if (const auto errors = check(s); !errors.empty()) {
    throw std::invalid_argument(errors.front().field + " " + errors.front().reason);
  }
  return s;
}

}  // namespace

void bind_sensor(py::module_& m) {
  py::class_<Sensor>(
      m, "Sensor",
      "A sonar cone, or with the model 'beam' a fan of laser beams.\n\n"
      "Sensor(model, **settings): the attributes below, and the parameters of the model by name, e.g.\n"
      "Sensor('li2014', aperture_rad=0.4, max_range_m=5, rho_e=0.6). Raises ValueError naming the field.")
      .def(py::init(&make), py::arg("model") = "li2014")
      .def_property_readonly(
          "model", [](const Sensor& s) { return std::string(name(s.model)); }, "Name of the model.")
      .def_property(
          "T_robot_sensor", [](const Sensor& s) { return tuple(s.T_robot_sensor); },
          [](Sensor& s, const PoseTuple& p) { s.T_robot_sensor = pose(p); },
          "Mount in the robot's frame: (x_m, y_m, yaw_rad).")
      .def_readwrite("aperture_rad", &Sensor::aperture_rad, "Full opening of a cone.")
      .def_readwrite("min_range_m", &Sensor::min_range_m, "Nearer readings are refused.")
      .def_readwrite("max_range_m", &Sensor::max_range_m, "Cones: farther readings are refused; fans clear up to it.")
      .def_readwrite("no_return_m", &Sensor::no_return_m, "Readings at or above it mean: no echo.")
      .def_readwrite("clear_no_return", &Sensor::clear_no_return, "Whether 'no echo' clears up to max_range_m (fans).")
      .def_readwrite("reliability", &Sensor::reliability, "Shafer discount of every reading, in (0, 1].")
      .def_readwrite("reliability_if_empty", &Sensor::reliability_if_empty, "Contextual discount.")
      .def_readwrite("reliability_if_occupied", &Sensor::reliability_if_occupied, "Contextual discount.")
      .def_readwrite("decay_s", &Sensor::decay_s, "What it says is forgotten with this time constant; 0: the map's.")
      .def_readwrite("weight_exponent", &Sensor::weight_exponent, "Of the dependence 'weighted'.")
      .def_readwrite("beams", &Sensor::beams, "Ranges in one reading.")
      .def_readwrite("first_beam_rad", &Sensor::first_beam_rad, "Bearing of beam 0, counter-clockwise.")
      .def_readwrite("beam_step_rad", &Sensor::beam_step_rad, "Bearing from one beam to the next.")
      .def_property(
          "dependence", [](const Sensor& s) { return std::string(name(s.dependence)); },
          [](Sensor& s, const std::string& v) { s.dependence = named(dependence_from_name(v), "dependence", v); },
          "'independent', 'cautious', 'once_per_scan' or 'weighted'.")
      .def(
          "parameters",
          [](const Sensor& s) {
            py::dict out;
            for (const ModelParam& p : model_params(s.model)) out[py::str(p.name)] = *model_param(s, s.model, p.name);
            return out;
          },
          "The parameters of the model: {name: value}.")
      .def(
          "evaluate",
          [](const Sensor& s, double range_m, double distance_m, double theta_rad) {
            const ModelMass mass = evaluate(s, range_m, distance_m, theta_rad);
            return std::make_tuple(mass.e, mass.o, mass.u, mass.c);
          },
          py::arg("range_m"), py::arg("distance_m"), py::arg("theta_rad") = 0.0,
          "Masses (e, o, u, c) of one reading at a point of the cone, distance_m from the sensor, theta_rad off its "
          "axis.")
      .def("__repr__", [](const Sensor& s) { return "<evigrid.Sensor " + std::string(name(s.model)) + ">"; });
}

}  // namespace evigrid::python
