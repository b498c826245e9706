// SPDX-License-Identifier: Apache-2.0
#include "paper/li2006_methods.hpp"

#include <fmt/format.h>

#include "error.hpp"
#include "evigrid/combine.hpp"
#include "mapping.hpp"
#include "paper/paper_world.hpp"
#include "picture/furniture.hpp"
#include "picture/sheet.hpp"
#include "score/truth.hpp"
#include "simulated.hpp"

namespace evigrid::driver::li2006 {

Drive make_drive(const PaperOptions& o, bool mirrors) {
  scenes::Scene scene = paper_scene(o, "li2006", "pioneer16");
  if (mirrors) {
    cover_all(scene.world, 25);
    scene.echo.second_bounce = true;
  }
  SceneTruth truth = scene_truth(scene, scene.map.cell_m);
  if (!truth.grid) throw InputError("the true room: " + truth.why_not);
  Drive d{simulate(scene, {.threads = o.threads}).log, scene.map.cell_m, std::move(*truth.grid)};
  d.rect = {d.truth.x, d.truth.y, d.truth.width, d.truth.height};
  return d;
}

Log as(const Log& log, Model model, double rho_v) {
  Log out = log;
  for (LogSensor& s : out.sensors) {
    s.sensor.model = model;
    s.sensor.reliability = 1;
    s.sensor.li2006.rho_v = rho_v;
  }
  return out;
}

Mapped mapped(const Drive& drive, Rule rule, Model model, double rho_v, int threads) {
  MappingOptions options;
  options.cell_m = drive.cell_m;
  Plan plan{{.cell_m = drive.cell_m, .rule = rule}, parse_executor("tbb", threads)};
  const Fused f = fuse(as(drive.log, model, rho_v), options, std::move(plan));
  Mapped out{render_layers(f.map, drive.rect, "map", options.max_image_mb), {}, f.fusion_s};
  out.score = score(out.layers, drive.truth);
  return out;
}

Agreement as_drawn(const Mapped& map, Look look, const scenes::TruthGrid& truth) {
  Overlay over = overlay(map.layers, truth);
  const CellRect& r = map.layers.rect;
  for (std::size_t i = 0; i < map.layers.cells(); ++i) {
    const auto x = r.x + static_cast<std::int64_t>(i) % r.width - over.rect.x;
    const auto y = r.y + static_cast<std::int64_t>(i) / r.width - over.rect.y;
    over.map[static_cast<std::size_t>(y * over.rect.width + x)] = never_seen(map.layers, i) ? Decision::unknown
                                                                  : value_of(look, map.layers, i) > 0.5
                                                                      ? Decision::occupied
                                                                      : Decision::empty;
  }
  return score(map.layers, truth, over).strict;
}

Canvas draw_methods(const std::array<Mapped, 4>& maps, const Drive& drive) {
  const SheetScale scale = sheet_scale(drive.rect, 360);
  std::vector<Panel> panels{{"truth", {"dark: surfaces  pale: free"}, thumbnail(drive.truth, scale)}};
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const Layers& l = maps[i].layers;
    panels.push_back({kMethods[i].name,
                      {fmt::format("grey: {}", kMethods[i].shown_as),
                       fmt::format("precision {:.3f}  mistaken {:.3f}", maps[i].score.strict.precision,
                                   maps[i].score.strict.mistaken_rate)},
                      thumbnail_of(scale, [&](std::int64_t x, std::int64_t y) -> std::pair<float, Rgb> {
                        x -= l.rect.x, y -= l.rect.y;
                        if (x < 0 || y < 0 || x >= l.rect.width || y >= l.rect.height) return {-1, kPaper};
                        const double v = value_of(kMethods[i].shown, l, static_cast<std::size_t>(y * l.rect.width + x));
                        return {static_cast<float>(v), colour_of(Ramp::greys, v)};
                      })});
  }
  return draw_sheet("one drive, four methods", panels, 3);
}

Finding flips() {
  constexpr int kAgreeing = 20, kMost = 1000;
  std::array<int, 4> count{};
  std::string ours;
  for (std::size_t i = 0; i < count.size(); ++i) {
    const bool p = kMethods[i].rule == Rule::bayes;
    const std::array<double, 3> empty = p ? std::array{0.8, 0.2, 0.0} : std::array{0.6, 0.0, 0.4},
                                occupied{empty[1], empty[0], empty[2]};
    std::array<double, 3> cell = p ? std::array{0.5, 0.5, 0.0} : std::array{0.0, 0.0, 1.0};
    const auto add = [&](const std::array<double, 3>& reading) {
      combine(kMethods[i].rule, Planes<const double>{&cell[0], &cell[1], &cell[2]},
              Planes<const double>{&reading[0], &reading[1], &reading[2]}, Planes<double>{&cell[0], &cell[1], &cell[2]},
              nullptr, 1);
    };
    for (int n = 0; n < kAgreeing; ++n) add(empty);
    while (cell[1] <= cell[0] && count[i] < kMost) add(occupied), ++count[i];
    ours += fmt::format("{}{} {}", i == 0 ? "" : ", ", kMethods[i].name,
                        count[i] == kMost ? "never" : std::to_string(count[i]));
  }
  return {"readings to flip a cell after 20 agreeing ones",
          "",
          ours,
          Aim::fact,
          false,
          "readings of m = 0.6 (P = 0.2, 0.8), until m(occupied) is above m(empty); in double, without a map's limits",
          count};
}

}  // namespace evigrid::driver::li2006
