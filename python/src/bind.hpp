// SPDX-License-Identifier: Apache-2.0
// What the parts of the Python module share: poses and rectangles as tuples, words as enumerators, numpy arrays.
#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>

#include "evigrid/evigrid.hpp"

namespace evigrid::python {

namespace py = pybind11;

/// C order, converted where it must be.
template <class T>
using Array = py::array_t<T, py::array::c_style | py::array::forcecast>;

using PoseTuple = std::tuple<double, double, double>;
using RectTuple = std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>;

inline Pose2 pose(const PoseTuple& p) { return {std::get<0>(p), std::get<1>(p), std::get<2>(p)}; }
inline PoseTuple tuple(const Pose2& p) { return {p.x_m, p.y_m, p.yaw_rad}; }
inline CellRect rect(const RectTuple& r) { return {std::get<0>(r), std::get<1>(r), std::get<2>(r), std::get<3>(r)}; }
inline RectTuple tuple(const CellRect& r) { return {r.x, r.y, r.width, r.height}; }

/// Throws std::invalid_argument (ValueError) naming what is not there.
template <class T>
T named(std::optional<T> found, const char* what, const std::string& value) {
  if (!found) throw std::invalid_argument(std::string("no ") + what + " is called \"" + value + "\"");
  return *found;
}

/// A map as Python holds it. The interpreter's lock is released while it works; a lock of its own makes calls of
/// several threads wait for each other instead of meeting in the map. Who wants to read meanwhile takes a view.
class SharedMap {
 public:
  explicit SharedMap(Map map) : map_(std::move(map)) {}

  /// f(map) without the interpreter's lock. Throws std::logic_error when a RevisableMap took the map.
  template <class F>
  auto with(F&& f) {
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    if (!map_) throw std::logic_error("the map was handed to a RevisableMap: ask that one");
    return f(*map_);
  }
  Map take() {
    return with([&](Map& map) {
      Map out = std::move(map);
      map_.reset();
      return out;
    });
  }

 private:
  std::mutex mutex_;
  std::optional<Map> map_;
};

/// A scan as Python says it: readings as {sensor: range or ranges} or as pairs.
class ScanArgument {
 public:
  ScanArgument(std::int64_t stamp_ns, const PoseTuple& at, const py::object& readings);
  [[nodiscard]] Scan scan() const { return {stamp_ns_, pose_, readings_}; }

 private:
  std::int64_t stamp_ns_;
  Pose2 pose_;
  std::vector<Array<float>> arrays_;  // what the readings refer to
  std::vector<Reading> readings_;
};

void bind_sensor(py::module_&);
void bind_view(py::module_&);
void bind_map(py::module_&);
void bind_algebra(py::module_&);
void bind_raycast(py::module_&);

}  // namespace evigrid::python
