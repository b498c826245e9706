// SPDX-License-Identifier: Apache-2.0
// The compiled half of `import evigrid`.
#include <system_error>

#include "bind.hpp"

namespace evigrid::python {
namespace {

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> out;
  for (const auto item : list) out.emplace_back(name(item));
  return out;
}

}  // namespace
}  // namespace evigrid::python

PYBIND11_MODULE(_evigrid, m) {
  using namespace evigrid;
  namespace py = pybind11;
  m.attr("__version__") = EVIGRID_VERSION;
  m.attr("MATHS_VERSION") = kMathsVersion;
  m.attr("RULES") = py::cast(python::names_of(all_rules()));
  m.attr("MAP_RULES") = py::cast(python::names_of(map_rules()));
  m.attr("MODELS") = py::cast(python::names_of(all_models()));
  m.attr("LAYERS") = py::cast(python::names_of(all_layers()));
  py::register_exception<MapFileError>(m, "MapFileError", PyExc_OSError);
  py::register_local_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const std::invalid_argument& e) {
      PyErr_SetString(PyExc_ValueError, e.what());
    } catch (const std::length_error& e) {
      PyErr_SetString(PyExc_MemoryError, e.what());
    } catch (const std::out_of_range& e) {
      PyErr_SetString(PyExc_IndexError, e.what());
    } catch (const std::system_error& e) {  // of a page file
      PyErr_SetString(PyExc_OSError, e.what());
    } catch (const std::logic_error& e) {
      PyErr_SetString(PyExc_RuntimeError, e.what());
    }
  });
  python::bind_sensor(m);
  python::bind_view(m);
  python::bind_map(m);
  python::bind_algebra(m);
  python::bind_raycast(m);
}
