// SPDX-License-Identifier: Apache-2.0
#include "export/tables.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <ostream>

#include "export/sweep.hpp"
#include "out/costmap.hpp"
#include "progress.hpp"

namespace evigrid::driver {

void write_csv(const Exported& what, const std::vector<ExportPlane>& planes, bool metres, std::ostream& out) {
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  std::vector<Layer> layers;
  fmt::memory_buffer text;
  auto to = std::back_inserter(text);
  fmt::format_to(to, "{}", metres ? "x_m,y_m" : "ix,iy");
  for (const ExportPlane& plane : planes) {
    layers.push_back(plane.layer);
    fmt::format_to(to, ",{}", plane.name);
  }
  text.push_back('\n');
  const auto flush = [&] {
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    text.clear();
  };
  const double c = what.map.params().cell_m;
  Progress progress("exporting");
  sweep(
      what.map, layers,
      [&](CellIndex at, std::span<const float> values) {
        if (metres) {
          fmt::format_to(to, "{},{}", (static_cast<double>(at.x) + 0.5) * c, (static_cast<double>(at.y) + 0.5) * c);
        } else {
          fmt::format_to(to, "{},{}", at.x, at.y);
        }
        for (const float v : values) fmt::format_to(to, ",{}", v);
        text.push_back('\n');
        if (text.size() >= kPiece) flush();
      },
      [&](std::size_t tiles, std::size_t of) { progress.show(tiles, of); });
  flush();
}

void write_npy(const Exported& what, const std::vector<ExportPlane>& planes, const ExportOptions& o, OutDir& out) {
  const CellRect& r = what.rect;
  const double c = what.map.params().cell_m;
  const std::string size = fmt::format("{} x {} cells", r.width, r.height);
  require_fits(planes.front().name + ".npy (--region exports a part)", size,
               static_cast<double>(r.width) * static_cast<double>(r.height) * sizeof(float), o.max_image_mb);
  const std::string head = npy_head("<f4", fmt::format("({}, {})", r.height, r.width));
  std::vector<float> cells(static_cast<std::size_t>(r.width * r.height));
  nlohmann::ordered_json files = nlohmann::ordered_json::object();
  for (const ExportPlane& plane : planes) {
    what.map.render(plane.layer, r, cells, r.width);
    out.write(plane.name + ".npy", std::as_bytes(std::span(head)), std::as_bytes(std::span(cells)));
    files[plane.name] = {{"file", plane.name + ".npy"}, {"layer", name(plane.layer)}};
  }
  const nlohmann::ordered_json grid{
      {"cell_m", c},
      {"size_cells", {r.width, r.height}},
      {"origin_cells", {r.x, r.y}},
      {"origin_m", {static_cast<double>(r.x) * c, static_cast<double>(r.y) * c}},
      {"order",
       "float32, C order, [row, column]: row 0 is the smallest y, column 0 the smallest x; origin: lower left "
       "corner of cell [0, 0] in the map frame"},
      {"frame", o.frame},
      {"rule", name(what.map.params().rule)},
      {"source", what.source},
      {"map_hash", what.hash},
      {"planes", files}};
  out.write("grid.json", grid.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace evigrid::driver
