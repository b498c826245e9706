// SPDX-License-Identifier: Apache-2.0
// Maps: what is written. Every call gives the interpreter's lock back while it works.
#include <algorithm>

#include "bind.hpp"

namespace evigrid::python {

ScanArgument::ScanArgument(std::int64_t stamp_ns, const PoseTuple& at, const py::object& readings)
    : stamp_ns_(stamp_ns), pose_(pose(at)) {
  const py::object pairs = py::isinstance<py::dict>(readings) ? readings.attr("items")() : readings;
  std::vector<SensorId> ids;
  for (const py::handle& pair : pairs) {
    const auto two = pair.cast<std::pair<SensorId, py::object>>();
    auto ranges = Array<float>::ensure(two.second);
    if (!ranges) {
      PyErr_Clear();
      throw std::invalid_argument("the ranges of sensor " + std::to_string(two.first) + " are no numbers");
    }
    ids.push_back(two.first);
    arrays_.push_back(std::move(ranges));
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    readings_.push_back({ids[i], std::span(arrays_[i].data(), static_cast<std::size_t>(arrays_[i].size()))});
  }
}

namespace {

MapParams params_of(double cell_m, const std::string& rule, const std::string& kernel, const py::kwargs& more) {
  MapParams p;
  p.cell_m = cell_m;
  p.rule = named(rule_from_name(rule), "rule", rule);
  p.kernel = named(kernel_from_name(kernel), "kernel", kernel);
  for (const auto& [key, value] : more) {
    const auto name = key.cast<std::string>();
    if (name == "keep_conflict")
      p.keep_conflict = value.cast<bool>();
    else if (name == "keep_con")
      p.keep_con = value.cast<bool>();
    else if (name == "keep_last_conflict")
      p.keep_last_conflict = value.cast<bool>();
    else if (name == "memory_cap_bytes")
      p.memory_cap_bytes = value.cast<std::size_t>();
    else if (name == "false_reflection_m")
      p.false_reflection_m = value.cast<double>();
    else if (name == "decay_s")
      p.decay_s = value.cast<double>();
    else if (name == "likelihood")
      p.bayes.likelihood =
          named(likelihood_from_name(value.cast<std::string>()), "likelihood", value.cast<std::string>());
    else if (name == "least_p")
      p.bayes.least_p = value.cast<double>();
    else if (name == "most_p")
      p.bayes.most_p = value.cast<double>();
    else
      throw std::invalid_argument("a map has no setting \"" + name + "\"");
  }
  return p;
}

std::shared_ptr<Executor> executor_of(const std::string& name, int threads) {
  if (threads < 0) throw std::invalid_argument("threads must not be negative");
  std::shared_ptr<Executor> executor = make_executor(name, threads);
  if (!executor) throw std::invalid_argument("no executor is called \"" + name + "\"");
  return executor;
}

py::dict refused(const Report& r) {
  py::dict out;
  for (int i = 0; i < kRefusalCount; ++i) {
    if (r.refused[static_cast<std::size_t>(i)] > 0) {
      out[py::str(name(static_cast<Refusal>(i)))] = r.refused[static_cast<std::size_t>(i)];
    }
  }
  return out;
}

/// Masses as (height, width, 3 or 4): e, o, u and c.
std::vector<Mass> masses_of(const Array<float>& a) {
  if (a.ndim() != 3 || (a.shape(2) != 3 && a.shape(2) != 4)) {
    throw std::invalid_argument("masses must have the shape (height, width, 3 or 4)");
  }
  const auto width = static_cast<std::size_t>(a.shape(2));
  std::vector<Mass> out(static_cast<std::size_t>(a.shape(0) * a.shape(1)));
  const float* p = a.data();
  for (Mass& m : out) {
    m = {p[0], p[1], p[2], width == 4 ? p[3] : 0};
    p += width;
  }
  return out;
}

void bind_report(py::module_& m) {
  py::class_<Report>(m, "Report", "What became of the readings of a call.")
      .def_readonly("readings_used", &Report::readings_used)
      .def_readonly("readings_clipped", &Report::readings_clipped, "Used ones beyond max_range_m (fans).")
      .def_readonly("stamps_backwards", &Report::stamps_backwards)
      .def_readonly("cells_updated", &Report::cells_updated, "Pairs of a reading (fan: a scan) and a cell.")
      .def_readonly("total_conflicts", &Report::total_conflicts)
      .def_readonly("max_conflict", &Report::max_conflict)
      .def_property_readonly("refused", &refused, "{reason: count} of the readings that were not used.")
      .def_property_readonly("touched", [](const Report& r) { return tuple(r.touched); })
      .def("__repr__", [](const Report& r) {
        return "<evigrid.Report " + std::to_string(r.readings_used) + " readings used, " +
               std::to_string(r.refused_total()) + " refused, " + std::to_string(r.cells_updated) + " cells updated>";
      });
}

void bind_revisable(py::module_& m) {
  struct Revisable {
    std::mutex mutex;
    RevisableMap map;
  };
  const auto with = [](Revisable& self, auto&& f) {
    const py::gil_scoped_release release;
    const std::lock_guard lock(self.mutex);
    return f(self.map);
  };
  py::class_<Revisable>(
      m, "RevisableMap",
      "A map that can change its mind: it keeps its scans, and takes one back, moves its pose or all of\n"
      "them after a loop closure, by fusing anew only the tiles that are concerned.\n\n"
      "RevisableMap(map) takes the map over: it is not to be used any more. reorder_ns: a scan that is\n"
      "at most so late is put in its place by its stamp.")
      .def(py::init([](SharedMap& map, std::int64_t reorder_ns) {
             return std::unique_ptr<Revisable>(new Revisable{{}, RevisableMap(map.take(), {.reorder_ns = reorder_ns})});
           }),
           py::arg("map"), py::arg("reorder_ns") = 0)
      .def(
          "integrate",
          [with](Revisable& self, std::int64_t stamp, const PoseTuple& at, const py::object& readings) {
            const ScanArgument scan(stamp, at, readings);
            return with(self, [&](RevisableMap& r) { return r.integrate(scan.scan()).first; });
          },
          py::arg("stamp_ns"), py::arg("pose"), py::arg("readings"), "Fuses a scan; its id.")
      .def(
          "remove", [with](Revisable& self, ScanId id) { with(self, [&](RevisableMap& r) { r.remove(id); }); },
          py::arg("id"), "As if the scan had never come.")
      .def(
          "move",
          [with](Revisable& self, ScanId id, const PoseTuple& at) {
            with(self, [&](RevisableMap& r) { r.move(id, pose(at)); });
          },
          py::arg("id"), py::arg("pose"), "As if the scan had come from there.")
      .def(
          "rebuild",
          [with](Revisable& self, const std::vector<std::pair<ScanId, PoseTuple>>& poses) {
            std::vector<ScanPose> list;
            for (const auto& [id, at] : poses) list.push_back({id, pose(at)});
            return with(self, [&](RevisableMap& r) { return r.rebuild(list).tiles; });
          },
          py::arg("poses"), "New poses [(id, pose)] after a loop closure; how many tiles were fused anew.")
      .def(
          "poses",
          [with](Revisable& self) {
            std::vector<std::pair<ScanId, PoseTuple>> out;
            for (const ScanPose& p : with(self, [](RevisableMap& r) { return r.poses(); })) {
              out.emplace_back(p.id, tuple(p.T_map_robot));
            }
            return out;
          },
          "[(id, pose)] in the order of fusion.")
      .def("view", [with](Revisable& self) {
        return std::make_shared<MapView>(with(self, [](RevisableMap& r) { return r.view(); }));
      });
}

}  // namespace

void bind_map(py::module_& m) {
  bind_report(m);
  py::class_<SharedMap>(
      m, "Map",
      "An evidential occupancy grid: sparse, without borders. Calls of several threads wait for each other;\n"
      "to read while it fuses, take a view().\n\n"
      "Map(cell_m=0.05, rule='pcr5', kernel='auto', executor='tbb', threads=0, **settings) with the\n"
      "settings keep_conflict, keep_con, keep_last_conflict, memory_cap_bytes, false_reflection_m, decay_s and,\n"
      "of the rule bayes, likelihood, least_p, most_p. Raises ValueError naming the field.")
      .def(py::init([](double cell_m, const std::string& rule, const std::string& kernel, const std::string& executor,
                       int threads, const py::kwargs& more) {
             return std::make_unique<SharedMap>(
                 Map(params_of(cell_m, rule, kernel, more), executor_of(executor, threads)));
           }),
           py::arg("cell_m") = 0.05, py::arg("rule") = "pcr5", py::arg("kernel") = "auto", py::arg("executor") = "tbb",
           py::arg("threads") = 0)
      .def(
          "add", [](SharedMap& self, const Sensor& s) { return self.with([&](Map& map) { return map.add(s); }); },
          py::arg("sensor"), "Declares a sensor; its number.")
      .def(
          "integrate",
          [](SharedMap& self, std::int64_t stamp, const PoseTuple& at, const py::object& readings) {
            const ScanArgument scan(stamp, at, readings);
            return self.with([&](Map& map) { return map.integrate(scan.scan()); });
          },
          py::arg("stamp_ns"), py::arg("pose"), py::arg("readings"),
          "Fuses the readings of one robot at one time: pose is (x_m, y_m, yaw_rad), readings {sensor: range or array "
          "of\n"
          "ranges} or [(sensor, ranges)]. REP 117: inf nothing in range, -inf too close, nan invalid. A Report.")
      .def(
          "undo",
          [](SharedMap& self, std::int64_t stamp, const PoseTuple& at, const py::object& readings) {
            const ScanArgument scan(stamp, at, readings);
            return self.with([&](Map& map) { return map.undo(scan.scan()); });
          },
          py::arg("stamp_ns"), py::arg("pose"), py::arg("readings"),
          "Takes a scan back (rules dempster_log, murphy; RuntimeError for others: see RevisableMap).")
      .def(
          "advance_to", [](SharedMap& self, std::int64_t t) { self.with([&](Map& map) { map.advance_to(t); }); },
          py::arg("stamp_ns"), "Lets time pass without a scan, in maps that forget.")
      .def(
          "clear",
          [](SharedMap& self, const std::optional<RectTuple>& r) {
            self.with([&](Map& map) { r ? map.clear(rect(*r)) : map.clear(); });
          },
          py::arg("rect") = py::none(), "All cells, or those of a rectangle, as never seen.")
      .def(
          "page_to",
          [](SharedMap& self, const std::string& directory) { self.with([&](Map& map) { map.page_to(directory); }); },
          py::arg("directory"),
          "Beyond memory_cap_bytes the tiles that changed longest ago go to a file without a name in that directory,\n"
          "instead of MemoryError; no bit of the map changes. OSError when the file cannot be made or written.")
      .def(
          "set_window",
          [](SharedMap& self, const std::optional<RectTuple>& r) {
            self.with([&](Map& map) { map.set_window(r ? rect(*r) : CellRect{}); });
          },
          py::arg("rect"), "Rolling window in cells; None: no window.")
      .def(
          "protect", [](SharedMap& self, const RectTuple& r) { self.with([&](Map& map) { map.protect(rect(r)); }); },
          py::arg("rect"), "No reading changes these cells any more.")
      .def("unprotect", [](SharedMap& self) { self.with([](Map& map) { map.unprotect(); }); })
      .def(
          "write",
          [](SharedMap& self, std::int64_t x, std::int64_t y, const Array<float>& masses) {
            const std::vector<Mass> cells = masses_of(masses);
            const CellRect r{x, y, masses.shape(1), masses.shape(0)};
            self.with([&](Map& map) { map.write(r, cells, r.width); });
          },
          py::arg("x"), py::arg("y"), py::arg("masses"),
          "Says what is known without a sensor: masses[row, column] = (e, o, u[, c]) of the cell (x + column, y + "
          "row).")
      .def(
          "write_occupancy",
          [](SharedMap& self, std::int64_t x, std::int64_t y, const Array<std::int8_t>& grid, double certainty) {
            if (grid.ndim() != 2) throw std::invalid_argument("an occupancy grid has two dimensions");
            const CellRect r{x, y, grid.shape(1), grid.shape(0)};
            const std::span cells(grid.data(), static_cast<std::size_t>(grid.size()));
            self.with([&](Map& map) { map.write(r, cells, r.width, certainty); });
          },
          py::arg("x"), py::arg("y"), py::arg("occupancy"), py::arg("certainty"),
          "A prior map as nav_msgs/OccupancyGrid has it (-1, 0 ... 100).")
      .def(
          "merge",
          [](SharedMap& self, const MapView& from, const PoseTuple& at, double reliability) {
            return self.with([&](Map& map) { return merge(map, from, {pose(at), reliability}).cells; });
          },
          py::arg("view"), py::arg("pose") = PoseTuple{}, py::arg("reliability") = 1.0,
          "Takes in what another map says; pose takes its coordinates to ours. How many cells received something.")
      .def(
          "view",
          [](SharedMap& self) { return std::make_shared<MapView>(self.with([](Map& map) { return map.view(); })); },
          "The map as it is now, for ever: to read while the map goes on.")
      .def("hash", [](SharedMap& self) { return self.with([](Map& map) { return map.hash(); }); })
      .def(
          "save", [](SharedMap& self, const std::string& path) { self.with([&](Map& map) { save(map, path); }); },
          py::arg("path"), "Writes the map file, atomically. MapFileError (an OSError) says what is wrong.")
      .def_property_readonly("version",
                             [](SharedMap& self) { return self.with([](Map& map) { return map.version(); }); })
      .def_property_readonly("cell_m",
                             [](SharedMap& self) { return self.with([](Map& map) { return map.params().cell_m; }); })
      .def_property_readonly(
          "rule",
          [](SharedMap& self) { return self.with([](Map& map) { return std::string(name(map.params().rule)); }); })
      .def_property_readonly(
          "kernel", [](SharedMap& self) { return self.with([](Map& map) { return std::string(map.kernel_name()); }); },
          "Which kernel really runs.")
      .def_property_readonly("paged_bytes",
                             [](SharedMap& self) { return self.with([](Map& map) { return map.paged_bytes(); }); })
      .def_property_readonly("memory_bytes",
                             [](SharedMap& self) { return self.with([](Map& map) { return map.memory_bytes(); }); })
      .def(
          "sensors",
          [](SharedMap& self) {
            return self.with([](Map& map) { return std::vector<Sensor>(map.sensors().begin(), map.sensors().end()); });
          },
          "The sensors that were added, in their order.");
  m.def(
      "load",
      [](const std::string& path, const std::string& executor, int threads, std::optional<std::size_t> cap,
         const std::optional<std::string>& page_to) {
        LoadOptions options{.executor = executor_of(executor, threads), .memory_cap_bytes = cap};
        if (page_to) options.page_directory = *page_to;
        const py::gil_scoped_release release;
        return std::make_unique<SharedMap>(load(path, options));
      },
      py::arg("path"), py::arg("executor") = "tbb", py::arg("threads") = 0, py::arg("memory_cap_bytes") = py::none(),
      py::arg("page_to") = py::none(),
      "A saved map, to the bit; with page_to one larger than the cap, too. Raises MapFileError for damage and for "
      "what\n"
      "is no map.");
  bind_revisable(m);
}

}  // namespace evigrid::python
