// SPDX-License-Identifier: Apache-2.0
// Sonar cones and lasers cast into a flat world.
#include "bind.hpp"
#include "evigrid/raycast/scene.hpp"

namespace evigrid::python {
namespace {

using namespace raycast;
using Two = std::tuple<double, double>;

raycast::Point point(const Two& p) { return {std::get<0>(p), std::get<1>(p)}; }

World make_world(const std::vector<std::pair<Two, Two>>& walls,
                 const std::vector<std::tuple<double, double, double, double, double>>& boxes,
                 const std::vector<std::tuple<double, double, double>>& circles,
                 const std::vector<std::vector<Two>>& polygons, double critical_incidence_rad, double absorption) {
  const Material material{critical_incidence_rad, absorption};
  World w;
  for (const auto& [from, to] : walls) w.walls.push_back({point(from), point(to), material});
  for (const auto& [x, y, length, width, yaw] : boxes) w.boxes.push_back({{x, y}, length, width, yaw, material});
  for (const auto& [x, y, r] : circles) w.circles.push_back({{x, y}, r, material});
  for (const auto& outline : polygons) {
    Polygon p;
    for (const auto& v : outline) p.vertices.push_back(point(v));
    p.material = material;
    w.polygons.push_back(std::move(p));
  }
  return w;
}

/// REP 117: +inf no echo, −inf too close.
double range_of(const Echo& e) noexcept {
  if (e.status == EchoStatus::none) return std::numeric_limits<double>::infinity();
  if (e.status == EchoStatus::too_close) return -std::numeric_limits<double>::infinity();
  return e.range_m;
}

py::array_t<double> cast(const Scene& scene, const Array<double>& cones, int threads) {
  if (cones.ndim() != 2 || cones.shape(1) != 6) {
    throw std::invalid_argument(
        "cones must have the shape (n, 6): x_m, y_m, yaw_rad, aperture_rad, min_range_m, max_range_m");
  }
  const auto n = static_cast<std::size_t>(cones.shape(0));
  py::array_t<double> out(cones.shape(0));
  const double* p = cones.data();
  double* const to = out.mutable_data();
  const py::gil_scoped_release release;
  std::vector<ConeQuery> queries(n);
  for (ConeQuery& q : queries) {
    q = {p[0], p[1], p[2], p[3], p[4], p[5]};
    p += 6;
  }
  std::vector<Echo> echoes(n);
  scene.cast_cones(queries, echoes, {}, threads);
  for (std::size_t i = 0; i < n; ++i) to[i] = range_of(echoes[i]);
  return out;
}

}  // namespace

void bind_raycast(py::module_& m) {
  py::class_<Scene>(
      m, "Scene",
      "A flat world of walls ((x, y), (x, y)), boxes (x, y, length, width, yaw), circles (x, y, radius) and\n"
      "polygons [(x, y), ...], made ready for casting. All its surfaces share one material: beyond the critical\n"
      "incidence (from the normal; pi/2: never) sound is thrown away, and absorption shortens the reach.")
      .def(py::init([](const std::vector<std::pair<Two, Two>>& walls,
                       const std::vector<std::tuple<double, double, double, double, double>>& boxes,
                       const std::vector<std::tuple<double, double, double>>& circles,
                       const std::vector<std::vector<Two>>& polygons, double critical, double absorption) {
             return std::make_unique<Scene>(make_world(walls, boxes, circles, polygons, critical, absorption));
           }),
           py::arg("walls") = std::vector<std::pair<Two, Two>>{},
           py::arg("boxes") = std::vector<std::tuple<double, double, double, double, double>>{},
           py::arg("circles") = std::vector<std::tuple<double, double, double>>{},
           py::arg("polygons") = std::vector<std::vector<Two>>{},
           py::arg("critical_incidence_rad") = Material{}.critical_incidence_rad, py::arg("absorption") = 0.0)
      .def_property_readonly("surface_count", &Scene::surface_count)
      .def("cast", &cast, py::arg("cones"), py::arg("threads") = 1,
           "Sonar: the nearest surface in each closed cone that gives an echo, exactly. cones has the rows x_m, y_m,\n"
           "yaw_rad, aperture_rad (full), min_range_m, max_range_m; inf: no echo, -inf: too close.")
      .def(
          "cast_fan",
          [](const Scene& scene, const PoseTuple& at, double first, double step, int beams, double max_range_m) {
            if (beams < 0 || beams > 10'000'000) throw std::invalid_argument("beams must be within [0, 10^7]");
            py::array_t<double> out(beams);
            const std::span<double> ranges(out.mutable_data(), static_cast<std::size_t>(beams));
            const FanQuery query{std::get<0>(at), std::get<1>(at), std::get<2>(at), first, step, beams, max_range_m};
            const py::gil_scoped_release release;
            scene.cast_fan(query, ranges);
            return out;
          },
          py::arg("pose"), py::arg("first_rad"), py::arg("step_rad"), py::arg("beams"), py::arg("max_range_m"),
          "Laser: the first surface along each ray of a fan; inf beyond max_range_m.");
}

}  // namespace evigrid::python
