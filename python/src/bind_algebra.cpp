// SPDX-License-Identifier: Apache-2.0
// combine(): whole arrays of masses at once.
#include <array>

#include "bind.hpp"

namespace evigrid::python {
namespace {

/// Planes along the first axis: (3 or 4, ...).
template <class T>
Planes<T> planes_of(T* data, py::ssize_t planes, std::size_t n) {
  return {data, data + n, data + 2 * n, planes == 4 ? data + 3 * n : nullptr};
}

template <class T>
py::tuple combined(const std::string& rule_name, const std::vector<py::object>& sources, int threads) {
  const Rule rule = named(rule_from_name(rule_name), "rule", rule_name);
  if (sources.size() < 2) throw std::invalid_argument("combine: at least two sources");
  if (threads < 0) throw std::invalid_argument("threads must not be negative");
  std::vector<Array<T>> arrays;
  bool with_c = keeps_paradox(rule);
  for (const py::object& source : sources) {
    auto a = Array<T>::ensure(source);
    if (!a) throw py::error_already_set();
    if (a.ndim() < 1 || (a.shape(0) != 3 && a.shape(0) != 4)) {
      throw std::invalid_argument("combine: a source has its planes e, o, u[, c] along the first axis");
    }
    const auto same = [&](const Array<T>& b) {
      return a.ndim() == b.ndim() && std::equal(a.shape() + 1, a.shape() + a.ndim(), b.shape() + 1);
    };
    if (!arrays.empty() && !same(arrays.front())) throw std::invalid_argument("combine: sources of different shapes");
    with_c = with_c || a.shape(0) == 4;
    arrays.push_back(std::move(a));
  }
  std::vector<py::ssize_t> shape(arrays.front().shape(), arrays.front().shape() + arrays.front().ndim());
  std::size_t n = 1;
  for (std::size_t i = 1; i < shape.size(); ++i) n *= static_cast<std::size_t>(shape[i]);
  shape[0] = with_c ? 4 : 3;
  py::array_t<T> out(shape);
  py::array_t<T> conflict(std::vector<py::ssize_t>(shape.begin() + 1, shape.end()));
  std::vector<Planes<const T>> planes;
  for (const auto& a : arrays) planes.push_back(planes_of<const T>(a.data(), a.shape(0), n));
  const Planes<T> to = planes_of<T>(out.mutable_data(), shape[0], n);
  T* const k = conflict.mutable_data();
  {
    const py::gil_scoped_release release;
    const auto executor = threads == 1 ? nullptr : make_tbb_executor(threads);
    const std::span<const Planes<const T>> all(planes);
    if constexpr (std::is_same_v<T, float>) {
      combine(rule, all, to, k, n, Kernel::automatic, executor.get());
    } else {
      combine(rule, all, to, k, n, executor.get());
    }
  }
  return py::make_tuple(out, conflict);
}

}  // namespace

void bind_algebra(py::module_& m) {
  m.def(
      "combine",
      [](const std::string& rule, const py::args& sources, int threads, bool exact) {
        std::vector<py::object> list;
        for (const auto& s : sources) list.push_back(py::reinterpret_borrow<py::object>(s));
        return exact ? combined<double>(rule, list, threads) : combined<float>(rule, list, threads);
      },
      py::arg("rule"), py::kw_only(), py::arg("threads") = 1, py::arg("double") = false,
      "combine(rule, a, b, ..., threads=1, double=False) -> (masses, conflict)\n\n"
      "Combines sources in their order. A source has its planes e, o, u (and c) along the first axis and any shape "
      "behind\n"
      "it; so has the result, in float32, or in float64 with double=True. conflict is k, summed over the steps.");
}

}  // namespace evigrid::python
