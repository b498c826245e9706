// SPDX-License-Identifier: Apache-2.0
// Asharif, Hosein Nezhad & Moshiri 2001, section 5: the same readings fused by Dempster's rule and by Bayes', and eight
// ways planned by A* on either map. The claim: Bayes' map is the cleaner one, Dempster's the safer one.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "error.hpp"
#include "evigrid/scenes/simulate.hpp"
#include "mapping.hpp"
#include "paper/agreement.hpp"
#include "paper/paper_world.hpp"
#include "paper/plot.hpp"
#include "paper/robot_map.hpp"
#include "paper/routes.hpp"
#include "paper/runs.hpp"
#include "picture/furniture.hpp"
#include "picture/ramp.hpp"
#include "score/truth.hpp"
#include "simulated.hpp"

namespace evigrid::driver {
namespace {

constexpr double kRevolve_rad_s = std::numbers::pi / 4;  // "it revolves while navigating" (ours: how fast)
constexpr double kLaserAperture_rad = 2 * std::numbers::pi / 180, kLaserDelta_m = 0.1, kLaserRhoV_m = 4;
constexpr Floors kFloors{.precision = 0.8, .recall = 0.8, .mistaken_rate = 0.1};

/// Section 5, in cells of the paper's map: P1 … P8.
constexpr std::array<std::pair<GridCell, GridCell>, 8> kRoutes{{{{20, 20}, {120, 180}},
                                                                {{20, 180}, {120, 20}},
                                                                {{20, 20}, {80, 80}},
                                                                {{120, 180}, {80, 80}},
                                                                {{20, 180}, {80, 80}},
                                                                {{120, 20}, {80, 80}},
                                                                {{80, 20}, {80, 80}},
                                                                {{80, 180}, {80, 80}}}};

/// One rule's map of the readings and the eight ways on it.
struct Planned {
  std::string name;
  Layers layers;
  std::vector<float> m{};
  Score score{};
  double off_ideal = 0;  ///< mean |m − truth| over the cells that are free or surface
  std::vector<Way> ways{};
};

struct Room {
  PaperWorld world;
  scenes::TruthGrid truth;
  CellRect rect;  ///< of the world, without the margin of the truth
  Clearance clearance;
  std::vector<Route> routes;
};

raycast::Point start_of(const scenes::Scene& scene) {
  if (scene.trajectory.start) return {scene.trajectory.start->x_m, scene.trajectory.start->y_m};
  return scene.trajectory.waypoints.front();
}

/// The paper's eight routes; in a plan of the user's eight between far places of the tour.
std::vector<Route> routes_of(const scenes::Scene& scene, const CellRect& rect, bool paper_room) {
  std::vector<Route> out;
  const auto& way = scene.trajectory.waypoints;
  const auto cell = [&](raycast::Point p) {
    return GridCell{static_cast<int>(std::floor(p.x_m / scene.map.cell_m) - static_cast<double>(rect.x)),
                    static_cast<int>(std::floor(p.y_m / scene.map.cell_m) - static_cast<double>(rect.y))};
  };
  for (std::size_t i = 0; i < kRoutes.size(); ++i) {
    const std::string name = fmt::format("P{}", i + 1);
    if (paper_room) {
      out.push_back({name, kRoutes[i].first, kRoutes[i].second});
    } else {
      const std::size_t at = i * way.size() / kRoutes.size();
      out.push_back({name, cell(way[at]), cell(way[(at + way.size() / 2) % way.size()])});
    }
  }
  return out;
}

Room make_room(const PaperOptions& o) {
  scenes::Scene scene = paper_scene(o, "asharif2001", "asharif8x8");
  const double c = scene.map.cell_m;
  SceneTruth truth = scene_truth(scene, c);
  if (!truth.grid) throw InputError("the true room: " + truth.why_not);
  const scenes::Extent box = scenes::extent(scene.world);
  CellRect rect{std::llround(std::floor(box.low.x_m / c)), std::llround(std::floor(box.low.y_m / c)), 0, 0};
  rect.width = std::llround(std::ceil(box.high.x_m / c)) - rect.x;
  rect.height = std::llround(std::ceil(box.high.y_m / c)) - rect.y;
  Clearance clearance(scene.world, rect, c, start_of(scene));
  std::vector<Route> routes = routes_of(scene, rect, o.world.empty());
  return {PaperWorld(std::move(scene)), std::move(*truth.grid), rect, std::move(clearance), std::move(routes)};
}

/// The readings along the scene's way, the robot turning all the while, so that its few sensors see everything.
Log sensed(const PaperWorld& w, std::uint64_t seed) {
  std::vector<scenes::Pose> poses = scenes::drive(w.scene.trajectory);
  for (std::size_t i = 0; i < poses.size(); ++i)
    poses[i].yaw_rad += kRevolve_rad_s * w.scene.trajectory.period_s * static_cast<double>(i);
  const scenes::Fleet robot(*w.floor, *w.caster, w.scene, {.robots = 1, .seed = seed});
  Log log;
  log.format = "scene";
  log.sensors = declared_sensors(w.scene);
  log.ranges_m.resize(poses.size() * robot.ranges_per_scan());
  robot.measure(0, poses, log.ranges_m);
  std::size_t at = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    log.scans.push_back({std::llround(1e9 * w.scene.trajectory.period_s * static_cast<double>(i)), to_engine(poses[i]),
                         log.readings.size(), log.sensors.size()});
    for (std::size_t s = 0; s < log.sensors.size(); ++s) {
      const auto count = static_cast<std::size_t>(log.sensors[s].sensor.beams);
      log.readings.push_back({s, at, count});
      at += count;
    }
  }
  return log;
}

/// The lasers as the paper has them: Oriolo's model, narrow and sharp, believed farther than a sonar.
Log with_oriolo_lasers(Log log) {
  for (LogSensor& s : log.sensors) {
    if (s.sensor.model != Model::beam) continue;
    s.sensor.model = Model::oriolo1997;
    s.sensor.aperture_rad = kLaserAperture_rad;
    s.sensor.oriolo.delta_m = kLaserDelta_m;
    s.sensor.oriolo.rho_v_m = kLaserRhoV_m;
  }
  return log;
}

void plan_ways(Planned& map, const Room& room, const StepCost& cost) {
  Planner planner;
  const CostGrid grid = cost_grid(map.layers, map.m, cost);
  map.ways.clear();
  for (const Route& r : room.routes)
    map.ways.push_back(room.clearance.judge(planner, grid, r, room.world.scene.radius_m));
}

Planned fused(const Log& log, Rule rule, const Room& room, int threads) {
  MappingOptions options;
  options.cell_m = room.world.scene.map.cell_m;
  Plan plan{{.cell_m = room.world.scene.map.cell_m, .rule = rule}, parse_executor("tbb", threads)};
  plan.params.bayes = {
      .likelihood = Likelihood::betp, .least_p = 1e-9, .most_p = 1 - 1e-9};  // the paper clamps nothing
  const Fused f = fuse(log, options, plan);
  Planned out{rule == Rule::bayes ? "Bayes" : "Dempster", render_layers(f.map, room.rect, "map", options.max_image_mb)};
  out.m = occupancy(out.layers);
  out.score = score(out.layers, room.truth);
  std::size_t cells = 0;
  for (std::size_t i = 0; i < out.m.size(); ++i) {
    const auto x = static_cast<std::int64_t>(i) % room.rect.width, y = static_cast<std::int64_t>(i) / room.rect.width;
    const scenes::TruthCell t = room.truth.at(room.rect.x + x, room.rect.y + y);
    if (t == scenes::TruthCell::solid) continue;
    out.off_ideal += std::abs(static_cast<double>(out.m[i]) - (t == scenes::TruthCell::surface));
    ++cells;
  }
  out.off_ideal /= static_cast<double>(std::max<std::size_t>(cells, 1));
  return out;
}

/// Of the routes that both maps have a way for.
struct Compared {
  std::size_t routes = 0, farther = 0;  ///< farther: Dempster's least clearance is at least Bayes'
  std::array<double, 2> least_m{}, mean_m{}, length_m{};
  std::array<std::size_t, 2> found{}, in_obstacle{}, too_near{};  ///< routes; routes with such cells
};

Compared compared(const Planned& dempster, const Planned& bayes) {
  Compared c;
  for (std::size_t i = 0; i < dempster.ways.size(); ++i) {
    const std::array<const Way*, 2> both{&dempster.ways[i], &bayes.ways[i]};
    const bool comparable = both[0]->found && both[1]->found;
    c.routes += comparable;
    c.farther += comparable && both[0]->least_m >= both[1]->least_m;
    for (std::size_t k = 0; k < 2; ++k) {
      c.found[k] += both[k]->found;
      c.in_obstacle[k] += both[k]->in_obstacle > 0;
      c.too_near[k] += both[k]->too_near > 0;
      if (!comparable) continue;
      c.least_m[k] += both[k]->least_m, c.mean_m[k] += both[k]->mean_m, c.length_m[k] += both[k]->length_m;
    }
  }
  for (auto* sums : {&c.least_m, &c.mean_m, &c.length_m})
    for (double& v : *sums) v = c.routes == 0 ? NAN : v / static_cast<double>(c.routes);
  return c;
}

std::string both(const std::array<double, 2>& v, const char* unit) {
  return fmt::format("Dempster {:.3f}{}, Bayes {:.3f}{}", v[0], unit, v[1], unit);
}
std::string both(const std::array<std::size_t, 2>& v, std::size_t of) {
  return fmt::format("Dempster {} of {}, Bayes {} of {}", v[0], of, v[1], of);
}

/// m as the paper draws it (black = 1), true surfaces in red, the ways on top.
Canvas draw_ways(const Planned& map, const Room& room, bool ways) {
  constexpr std::array<Rgb, 8> kColours{{{0, 114, 178},
                                         {230, 120, 0},
                                         {0, 158, 115},
                                         {204, 60, 140},
                                         {86, 160, 233},
                                         {160, 130, 0},
                                         {120, 60, 180},
                                         {200, 40, 40}}};
  constexpr Rgb kTrue{214, 60, 50};
  constexpr int kKey_px = 30;
  const int scale = scale_for(room.rect, 560);
  const MapFrame frame{kMargin_px, kHead_px, scale, room.rect, map.layers.cell_m};
  Canvas canvas(std::max(frame.width_px(), 460) + 2 * kMargin_px, frame.height_px() + kHead_px + kKey_px + kMargin_px,
                kPaper);
  draw_head(canvas, {map.name + (ways ? ": ways" : ": map"),
                     ways ? "black: m = 1   red: true surfaces" : "black: m = 1, white: m = 0"});
  draw_cells(canvas, frame, [&](std::size_t i) {
    const auto x = static_cast<std::int64_t>(i) % room.rect.width, y = static_cast<std::int64_t>(i) / room.rect.width;
    const Rgb grey = colour_of(Ramp::greys, map.m[i]);
    const bool surface = room.truth.at(room.rect.x + x, room.rect.y + y) == scenes::TruthCell::surface;
    return ways && surface ? blend(grey, kTrue, 0.6) : grey;
  });
  const int foot = kHead_px + frame.height_px() + 8;
  draw_scale_bar(canvas, canvas.width() - kMargin_px, foot, scale / map.layers.cell_m);
  if (!ways) return canvas;
  const auto px = [&](GridCell c) {
    return std::pair{frame.left + (c.x + 0.5) * scale,
                     frame.top + (static_cast<double>(room.rect.height) - c.y - 0.5) * scale};
  };
  for (std::size_t r = 0; r < map.ways.size(); ++r) {
    const auto& cells = map.ways[r].cells;
    for (std::size_t i = 1; i < cells.size(); ++i) {
      const auto [x0, y0] = px(cells[i - 1]);
      const auto [x1, y1] = px(cells[i]);
      canvas.line(x0, y0, x1, y1, 2, kColours[r % kColours.size()]);
    }
    canvas.text(kMargin_px + static_cast<int>(r) * 34, foot, room.routes[r].name, 2, kColours[r % kColours.size()]);
  }
  for (std::size_t r = 0; r < room.routes.size(); ++r) {
    for (const GridCell end : {room.routes[r].from, room.routes[r].to}) {
      const auto [x, y] = px(end);
      canvas.disc(x, y, 5, kPaper);
      canvas.disc(x, y, 3.5, kColours[r % kColours.size()]);
    }
  }
  return canvas;
}

std::vector<std::vector<std::string>> route_rows(const Planned& d, const Planned& b, const Room& room) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < room.routes.size(); ++i) {
    const Route& r = room.routes[i];
    for (const Planned* map : {&d, &b}) {
      const Way& w = map->ways[i];
      std::vector<std::string> row{fmt::format("{}: ({},{}) to ({},{})", r.name, r.from.x, r.from.y, r.to.x, r.to.y),
                                   map->name};
      if (w.found) {
        for (const double v : {w.length_m, w.least_m, w.mean_m}) row.push_back(fmt::format("{:.2f}", v));
        row.push_back(std::to_string(w.in_obstacle));
        row.push_back(std::to_string(w.too_near));
      } else {
        row.emplace_back("no way");
        row.resize(7);
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

struct Sweep {
  std::vector<std::vector<std::string>> rows;
  std::size_t settings = 0, comparable = 0, farther_least = 0, farther_mean = 0;
  PlotSeries dempster{"Dempster, least", {}, true}, bayes{"Bayes, least", {}, true},
      dempster_mean{"Dempster, mean", {}, true}, bayes_mean{"Bayes, mean", {}, true};
};

Sweep sweep(Planned dempster, Planned bayes, const Room& room, bool quick) {
  Sweep out;
  const std::vector<double> weights = quick ? std::vector<double>{1, 10} : std::vector<double>{0, 1, 3, 10, 30, 100};
  const std::vector<double> thresholds =
      quick ? std::vector<double>{0.8} : std::vector<double>{0.5, 0.65, 0.8, 0.95, 1};
  for (const double blocked : thresholds) {
    for (const double weight : weights) {
      for (Planned* map : {&dempster, &bayes}) plan_ways(*map, room, {weight, blocked});
      const Compared c = compared(dempster, bayes);
      ++out.settings;
      if (c.routes > 0) {
        ++out.comparable;
        out.farther_least += c.least_m[0] > c.least_m[1];
        out.farther_mean += c.mean_m[0] > c.mean_m[1];
      }
      const auto pair = [](const auto& v, const char* format) {
        return fmt::format(fmt::runtime(format), v[0]) + " / " + fmt::format(fmt::runtime(format), v[1]);
      };
      out.rows.push_back({fmt::format("{:g}", weight), fmt::format("{:g}", blocked), pair(c.found, "{}"),
                          pair(c.least_m, "{:.2f}"), pair(c.mean_m, "{:.2f}"), pair(c.length_m, "{:.1f}"),
                          pair(c.in_obstacle, "{}"), pair(c.too_near, "{}")});
      if (blocked == StepCost{}.blocked_above) {
        const double x = std::log10(std::max(weight, 0.1));
        out.dempster.points.emplace_back(x, c.least_m[0]);
        out.bayes.points.emplace_back(x, c.least_m[1]);
        out.dempster_mean.points.emplace_back(x, c.mean_m[0]);
        out.bayes_mean.points.emplace_back(x, c.mean_m[1]);
      }
    }
  }
  return out;
}

}  // namespace

PaperResult run_asharif2001(const PaperOptions& o) {
  const Room room = make_room(o);
  const bool paper_room = o.world.empty();
  const StepCost cost;
  const Log log = sensed(room.world, room.world.scene.trajectory.seed), oriolo = with_oriolo_lasers(log);
  Planned dempster = fused(oriolo, Rule::dempster, room, o.threads),
          bayes = fused(oriolo, Rule::bayes, room, o.threads);
  for (Planned* map : {&dempster, &bayes}) plan_ways(*map, room, cost);
  const Compared c = compared(dempster, bayes);
  const Sweep swept = sweep(dempster, bayes, room, o.quick);
  Planned beam_d = fused(log, Rule::dempster, room, o.threads), beam_b = fused(log, Rule::bayes, room, o.threads);
  for (Planned* map : {&beam_d, &beam_b}) plan_ways(*map, room, cost);
  const Compared beams = compared(beam_d, beam_b);

  std::size_t seeds = 0, farther_least = 0, farther_mean = 0;  // other noise, the same way
  for (std::uint64_t k = 1; k <= (o.quick ? 1U : 10U); ++k) {
    const Log other = with_oriolo_lasers(sensed(room.world, room.world.scene.trajectory.seed + k));
    Planned d = fused(other, Rule::dempster, room, o.threads), b = fused(other, Rule::bayes, room, o.threads);
    for (Planned* map : {&d, &b}) plan_ways(*map, room, cost);
    const Compared of_seed = compared(d, b);
    if (of_seed.routes == 0) continue;
    ++seeds;
    farther_least += of_seed.least_m[0] > of_seed.least_m[1];
    farther_mean += of_seed.mean_m[0] > of_seed.mean_m[1];
  }

  PaperResult out{Page("Dempster against Bayes for path planning",
                       "M. R. Asharif, R. Hosein Nezhad, B. Moshiri: Environment mapping for mobile robots navigation "
                       "using sensor fusion: a Dempster-Shafer reasoning theory approach. 2001."),
                  {}};
  const Aim target = paper_room ? Aim::target : Aim::reported;
  const std::size_t all = room.routes.size();
  const std::string how = fmt::format(
      "mean over the {} routes that both maps have a way for; step cost length x (1 + {:g} m), blocked above m = {:g}",
      c.routes, cost.weight, cost.blocked_above);
  out.findings = {
      {"least clearance of the ways from the true room", "Dempster's farther than Bayes'", both(c.least_m, " m"),
       target, c.least_m[0] > c.least_m[1], how, c.least_m},
      {"mean clearance of the ways", "Dempster's farther than Bayes'", both(c.mean_m, " m"), target,
       c.mean_m[0] > c.mean_m[1], how, c.mean_m},
      {"the map nearer to the ideal one",
       "Bayes'",
       both({dempster.off_ideal, bayes.off_ideal}, ""),
       target,
       bayes.off_ideal < dempster.off_ideal,
       "mean |m - truth| over the cells that are free or wall; m = max(1 - m(empty), m(occupied)), respectively P",
       {dempster.off_ideal, bayes.off_ideal}},
      {"routes where Dempster's way keeps at least as far as Bayes'", "all eight, by figures 4 and 5",
       fmt::format("{} of {}", c.farther, c.routes), Aim::reported, false, "least clearance", c.farther},
      {"routes with a way", "", both(c.found, all), Aim::fact, false, "start and goal in cells that are not blocked",
       c.found},
      {"ways through the true obstacles", "none drawn", both(c.in_obstacle, all), Aim::reported, false,
       "routes with a cell whose centre lies in an obstacle or a wall", c.in_obstacle},
      {"ways on which the robot would touch something", "", both(c.too_near, all), Aim::fact, false,
       fmt::format("routes with a cell nearer than the robot's radius of {:g} m", room.world.scene.radius_m),
       c.too_near},
      {"mean length of the ways", "", both(c.length_m, " m"), Aim::fact, false, how, c.length_m},
      {"settings of the cost under which Dempster's ways keep farther",
       "",
       fmt::format("least clearance {}, mean {} of {}", swept.farther_least, swept.farther_mean, swept.comparable),
       Aim::fact,
       false,
       fmt::format("sweep of weight and threshold, {} settings, {} of them with ways on both maps", swept.settings,
                   swept.comparable),
       {swept.farther_least, swept.farther_mean, swept.comparable}},
      {"seeds under which Dempster's ways keep farther",
       "",
       fmt::format("least clearance {}, mean {} of {}", farther_least, farther_mean, seeds),
       Aim::fact,
       false,
       "the same way and cost, other noise of the readings",
       {farther_least, farther_mean, seeds}},
      {"the same with lasers as beams: least clearance", "", both(beams.least_m, " m"), Aim::fact, false,
       fmt::format("model beam for the 8 lasers; {} routes with ways on both maps", beams.routes), beams.least_m},
      {"the same with lasers as beams: mean clearance", "", both(beams.mean_m, " m"), Aim::fact, false, "the same",
       beams.mean_m},
  };
  if (paper_room) {
    for (const Planned* map : {&dempster, &bayes})
      for (Finding& f : agreement(map->name, map->score, kFloors)) out.findings.push_back(std::move(f));
  }
  out.files = {{"dempster.png", png(draw_ways(dempster, room, false))},
               {"bayes.png", png(draw_ways(bayes, room, false))},
               {"dempster_ways.png", png(draw_ways(dempster, room, true))},
               {"bayes_ways.png", png(draw_ways(bayes, room, true))}};

  Page& page = out.page;
  const std::string where = paper_room ? "a room of 15 x 20 m with four obstacles" : "the plan " + o.world;
  page.paragraph(fmt::format(
      "A robot with 8 sonars and 8 laser range finders maps {} in {} steps. The same readings are fused twice: as "
      "masses "
      "by Dempster's rule, and as P = (1 + o - e) / 2 by Bayes' rule. A* then plans eight ways on either map under one "
      "step cost.",
      where, log.scans.size()));
  page.findings(out.findings);
  page.heading("The maps");
  page.begin_row();
  for (std::size_t i = 0; i < 2; ++i) page.picture(out.files[i].bytes, out.files[i].name);
  page.end_row();
  page.heading("The ways");
  page.begin_row();
  for (std::size_t i = 2; i < 4; ++i) page.picture(out.files[i].bytes, out.files[i].name);
  page.end_row();
  page.table({"route", "map", "length, m", "least clearance, m", "mean clearance, m", "cells in obstacles",
              "cells nearer than the robot's radius"},
             route_rows(dempster, bayes, room));
  page.heading("Other costs");
  page.paragraph("Dempster / Bayes. Clearances and lengths: means over the routes that both maps have a way for.");
  page.raw(svg_plot({fmt::format("clearance against the weight, blocked above {:g}", cost.blocked_above),
                     "log10 of the weight (0: at -1)", "clearance, m"},
                    {swept.dempster, swept.bayes, swept.dempster_mean, swept.bayes_mean}));
  page.table({"weight", "blocked above", "routes with a way", "least clearance, m", "mean clearance, m", "length, m",
              "ways through obstacles", "ways where the robot touches"},
             swept.rows);
  page.heading("How the maps agree with the room");
  const MetricTable metrics = metric_table(
      {{"Dempster", dempster.score, mean_conflict(dempster.layers), rerender(dempster.layers, oriolo)},
       {"Bayes", bayes.score, mean_conflict(bayes.layers), rerender(bayes.layers, oriolo)},
       {"Dempster, lasers as beams", beam_d.score, mean_conflict(beam_d.layers), rerender(beam_d.layers, log)},
       {"Bayes, lasers as beams", beam_b.score, mean_conflict(beam_b.layers), rerender(beam_b.layers, log)}});
  page.table(metrics.head, metrics.rows);
  page.heading("What the text leaves open");
  page.list(
      {paper_room
           ? "The obstacles' places: ours; the paper has a drawing of them. All seven ends of the routes are free."
           : "The way and the routes: a tour through all that the robot can reach, and eight pairs of far places on "
             "it.",
       fmt::format("The lasers' model: Oriolo's as for the sonars, with an aperture of 2 degrees, an arc of {:g} "
                   "m on either side and belief halved at {:g} m. The last two rows of the findings and of the "
                   "metrics have them as beams instead.",
                   kLaserDelta_m, kLaserRhoV_m),
       "The cost of a step: the paper gives none. One for both maps: length x (1 + w m), blocked above a "
       "threshold; the sweep varies both.",
       "Clearance: from the centres of a way's cells to the nearest true surface, by an exact distance transform "
       "of the true room on a raster of " +
           fmt::format("{:.3f} m.", room.clearance.raster_m()),
       fmt::format("How fast the robot revolves: {:g} degrees/s.", kRevolve_rad_s * 180 / std::numbers::pi),
       "The random phase: waypoints drawn once; the paper's robot avoided obstacles by a fuzzy rule base. "
       "Probabilities are kept within 1e-9 of 0 and 1."});
  out.details["dempster"] = to_json(dempster.score);
  out.details["bayes"] = to_json(bayes.score);
  return out;
}

}  // namespace evigrid::driver
