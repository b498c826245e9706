// SPDX-License-Identifier: Apache-2.0
// Reading: views, their layers as new arrays, their tiles as arrays without a copy.
#include "bind.hpp"

namespace evigrid::python {
namespace {

constexpr std::size_t kMostCells = std::size_t{1} << 34;  // a picture beyond that is a mistake, not a wish

/// An array for the rectangle, rows from the smallest y.
template <class T>
py::array_t<T> picture(const CellRect& r) {
  if (r.width < 0 || r.height < 0) throw std::invalid_argument("a rectangle's width and height must not be negative");
  std::size_t cells = 0;
  if (__builtin_mul_overflow(static_cast<std::size_t>(r.width), static_cast<std::size_t>(r.height), &cells) ||
      cells > kMostCells) {
    throw std::invalid_argument("a rectangle of more than 2^34 cells: ask for a part of it");
  }
  return py::array_t<T>({r.height, r.width});
}

CellRect part(const MapView& view, const std::optional<RectTuple>& asked) {
  return asked ? rect(*asked) : view.bounds();
}

template <class T, class Draw>
py::array_t<T> drawn(const MapView& view, const std::optional<RectTuple>& asked, Draw&& draw) {
  const CellRect r = part(view, asked);
  py::array_t<T> out = picture<T>(r);
  if (r.empty()) return out;
  const std::span<T> cells(out.mutable_data(), static_cast<std::size_t>(out.size()));
  const py::gil_scoped_release release;
  draw(r, cells);
  return out;
}

/// One tile: where it is, and its planes as 16 × 4 × 16 × 4 arrays (block row, row, block column, column) in the view's
/// own memory; each array keeps the view alive.
struct Tile {
  std::shared_ptr<const MapView> view;
  TilePlanes planes;

  [[nodiscard]] py::array plane(const std::string& name) const {
    const auto names = view->plane_names();
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) throw std::invalid_argument("cells of this map have no plane \"" + name + "\"");
    constexpr py::ssize_t kBlock = TilePlanes::kBlock, kBlocks = TilePlanes::kSide / kBlock, kFloat = sizeof(float);
    const py::ssize_t block = planes.planes * TilePlanes::kBlockCells * kFloat;
    const auto owner =
        py::capsule(new std::shared_ptr(view), [](void* p) { delete static_cast<std::shared_ptr<const MapView>*>(p); });
    py::array out(py::dtype::of<float>(), std::vector<py::ssize_t>{kBlocks, kBlock, kBlocks, kBlock},
                  std::vector<py::ssize_t>{block * kBlocks, kBlock * kFloat, block, kFloat},
                  planes.data + (at - names.begin()) * TilePlanes::kBlockCells, owner);
    out.attr("flags").attr("writeable") = false;
    return out;
  }
};

py::dict changes_of(const Changes& c) {
  py::dict out;
  out["version"] = c.version;
  out["cleared"] = c.cleared;
  py::list rects;
  for (const CellRect& r : c.rects) rects.append(tuple(r));
  out["rects"] = rects;
  return out;
}

}  // namespace

void bind_view(py::module_& m) {
  py::class_<Tile>(m, "Tile", "A tile of 64 × 64 cells of a view, read where it lies.")
      .def_property_readonly(
          "rect", [](const Tile& t) { return tuple(t.planes.rect); }, "(x, y, width, height), cells.")
      .def(
          "plane", &Tile::plane, py::arg("name"),
          "A plane as a read-only float32 array of shape (16, 4, 16, 4) without a copy: block row, row, block column,\n"
          "column. plane.reshape(64, 64) is the tile row by row, a copy. Lives as long as it is referred to.");

  py::class_<MapView, std::shared_ptr<MapView>>(
      m, "View",
      "One version of a map: immutable, read by any number of threads while the map goes on. Arrays have the shape\n"
      "(height, width), row 0 at the smallest y; a rect is (x, y, width, height) in cells, by default all that was "
      "seen.")
      .def_property_readonly("version", &MapView::version, "Counts the calls that changed a cell of the map.")
      .def_property_readonly(
          "cell_m", [](const MapView& v) { return v.params().cell_m; }, "Side of a cell, m.")
      .def_property_readonly("rule", [](const MapView& v) { return std::string(name(v.params().rule)); })
      .def_property_readonly(
          "plane_names",
          [](const MapView& v) {
            const auto names = v.plane_names();
            return std::vector<std::string>(names.begin(), names.end());
          },
          "What each cell keeps.")
      .def(
          "bounds", [](const MapView& v) { return tuple(v.bounds()); }, py::call_guard<py::gil_scoped_release>(),
          "Smallest box around all cells that are not vacuous: (x, y, width, height).")
      .def("hash", &MapView::hash, py::call_guard<py::gil_scoped_release>(),
           "Hash of cells and float bits, independent of threads and tiles.")
      .def(
          "cell_at",
          [](const MapView& v, double x, double y) {
            const CellIndex c = v.cell_at(x, y);
            return std::make_tuple(c.x, c.y);
          },
          py::arg("x_m"), py::arg("y_m"), "The cell that a point of the map frame lies in: (x, y).")
      .def(
          "mass",
          [](const MapView& v, std::int64_t x, std::int64_t y) {
            const Mass c = v.mass({x, y});
            return std::make_tuple(c.e, c.o, c.u, c.c);
          },
          py::arg("x"), py::arg("y"), "Masses (e, o, u, c) of a cell; (0, 0, 1, 0) where nothing was seen.")
      .def(
          "render",
          [](const MapView& v, const std::string& layer, const std::optional<RectTuple>& r) {
            const Layer which = named(layer_from_name(layer), "layer", layer);
            return drawn<float>(v, r, [&](CellRect at, std::span<float> out) { v.render(which, at, out, at.width); });
          },
          py::arg("layer") = "betp", py::arg("rect") = py::none(), "A layer (see evigrid.LAYERS) as float32.")
      .def(
          "occupancy",
          [](const MapView& v, const std::optional<RectTuple>& r, double free_below, double lethal_above,
             double max_unknown) {
            const Costmap costs{free_below, lethal_above, max_unknown};
            return drawn<std::int8_t>(
                v, r, [&](CellRect at, std::span<std::int8_t> out) { v.render(costs, at, out, at.width); });
          },
          py::arg("rect") = py::none(), py::arg("free_below") = Costmap{}.free_below,
          py::arg("lethal_above") = Costmap{}.lethal_above, py::arg("max_unknown") = Costmap{}.max_unknown,
          "nav_msgs/OccupancyGrid as int8: -1 no information, 0 free ... 100 occupied.")
      .def(
          "costmap",
          [](const MapView& v, const std::optional<RectTuple>& r, double free_below, double lethal_above,
             double max_unknown) {
            const Costmap costs{free_below, lethal_above, max_unknown};
            return drawn<std::uint8_t>(
                v, r, [&](CellRect at, std::span<std::uint8_t> out) { v.render(costs, at, out, at.width); });
          },
          py::arg("rect") = py::none(), py::arg("free_below") = Costmap{}.free_below,
          py::arg("lethal_above") = Costmap{}.lethal_above, py::arg("max_unknown") = Costmap{}.max_unknown,
          "costmap_2d as uint8: 255 no information, 0 free, 254 lethal.")
      .def(
          "tiles",
          [](const std::shared_ptr<MapView>& v) {
            std::vector<Tile> out;
            for (const TilePlanes& t : v->tile_planes()) out.push_back({v, t});
            return out;
          },
          "All tiles, row by row: planes without a copy.")
      .def(
          "changes", [](const MapView& v, std::uint64_t since) { return changes_of(v.changes(since)); },
          py::arg("since") = 0, "What changed after a version: {'version', 'cleared', 'rects'}.")
      .def(
          "save", [](const MapView& v, const std::string& path) { save(v, path); }, py::arg("path"),
          py::call_guard<py::gil_scoped_release>(), "Writes the map file, atomically, while the map goes on.")
      .def("__repr__", [](const MapView& v) {
        return "<evigrid.View version " + std::to_string(v.version()) + ", " + std::to_string(v.tiles()) + " tiles>";
      });
}

}  // namespace evigrid::python
