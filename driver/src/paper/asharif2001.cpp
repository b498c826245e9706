// SPDX-License-Identifier: Apache-2.0
// Asharif, Hosein Nezhad & Moshiri 2001, section 5: the same readings fused by Dempster's rule and by Bayes', and eight
// ways planned by A* on either map. The claim: Bayes' map is the cleaner one, Dempster's the safer one.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "paper/agreement.hpp"
#include "paper/asharif2001_maps.hpp"
#include "paper/plot.hpp"
#include "paper/runs.hpp"

namespace evigrid::driver {
namespace {

using namespace asharif2001;

constexpr Floors kFloors{.precision = 0.8, .recall = 0.8, .mistaken_rate = 0.1};

std::string both(const std::array<double, 2>& v, const char* unit) {
  return fmt::format("Dempster {:.3f}{}, Bayes {:.3f}{}", v[0], unit, v[1], unit);
}
std::string both(const std::array<std::size_t, 2>& v, std::size_t of) {
  return fmt::format("Dempster {} of {}, Bayes {} of {}", v[0], of, v[1], of);
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

/// One log mapped by either rule, the ways planned on both.
struct ByBoth {
  Planned dempster, bayes;
};
ByBoth by_both(const Log& log, const Room& room, const StepCost& cost, int threads) {
  ByBoth out{fused(log, Rule::dempster, room, threads), fused(log, Rule::bayes, room, threads)};
  for (Planned* map : {&out.dempster, &out.bayes}) plan_ways(*map, room, cost);
  return out;
}

struct Slanting {
  std::vector<std::vector<std::string>> rows;
  std::string ours;
  nlohmann::ordered_json values = nlohmann::ordered_json::array();
};

/// The same way and seed among surfaces that throw sound away beyond a critical incidence.
Slanting among_slanting_surfaces(const PaperOptions& o, const Room& room, const StepCost& cost) {
  Slanting out;
  for (const double angle : o.quick ? std::vector<double>{35} : std::vector<double>{60, 45, 35, 25}) {
    scenes::Scene scene = room.world.scene;
    cover_all(scene.world, angle);
    const std::uint64_t seed = scene.trajectory.seed;
    const auto [d, b] = by_both(with_oriolo_lasers(sensed(PaperWorld(std::move(scene)), seed)), room, cost, o.threads);
    const Compared c = compared(d, b);
    const auto pair = [](const std::array<double, 2>& v) { return fmt::format("{:.3f} / {:.3f}", v[0], v[1]); };
    const std::array<double, 2> off{d.off_ideal, b.off_ideal};
    out.rows.push_back(
        {fmt::format("{:g}", angle), fmt::format("{}", c.routes), pair(c.least_m), pair(c.mean_m), pair(off)});
    out.ours += fmt::format("{}{:g} degrees: {} m", out.ours.empty() ? "" : "; ", angle, pair(c.least_m));
    out.values.push_back({angle, c.least_m, c.mean_m, off});
  }
  return out;
}

}  // namespace

PaperResult run_asharif2001(const PaperOptions& o) {
  const Room room = make_room(o);
  const bool paper_room = o.world.empty();
  const StepCost cost;
  const Log log = sensed(room.world, room.world.scene.trajectory.seed), oriolo = with_oriolo_lasers(log);
  const auto [dempster, bayes] = by_both(oriolo, room, cost, o.threads);
  const Compared c = compared(dempster, bayes);
  const Sweep swept = sweep(dempster, bayes, room, o.quick);
  const auto [beam_d, beam_b] = by_both(log, room, cost, o.threads);
  const Compared beams = compared(beam_d, beam_b);

  std::size_t seeds = 0, farther_least = 0, farther_mean = 0;  // other noise, the same way
  for (std::uint64_t k = 1; k <= (o.quick ? 1U : 10U); ++k) {
    const Log other = with_oriolo_lasers(sensed(room.world, room.world.scene.trajectory.seed + k));
    const auto [d, b] = by_both(other, room, cost, o.threads);
    const Compared of_seed = compared(d, b);
    if (of_seed.routes == 0) continue;
    ++seeds;
    farther_least += of_seed.least_m[0] > of_seed.least_m[1];
    farther_mean += of_seed.mean_m[0] > of_seed.mean_m[1];
  }

  const Slanting slanting = among_slanting_surfaces(o, room, cost);

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
      {"least clearance where surfaces throw sound away: Dempster / Bayes", "", slanting.ours, Aim::fact, false,
       "everything that stands of one critical incidence; the paper's simulation tells of none", slanting.values},
      {"the same with lasers as beams: least clearance", "", both(beams.least_m, " m"), Aim::fact, false,
       fmt::format("model beam for the 8 lasers; {} routes with ways on both maps", beams.routes), beams.least_m},
      {"the same with lasers as beams: mean clearance", "", both(beams.mean_m, " m"), Aim::fact, false, "the same",
       beams.mean_m},
  };
  if (paper_room) {
    for (const Planned* map : {&dempster, &bayes})
      for (Finding& f : agreement(map->name, map->score, kFloors)) out.findings.push_back(std::move(f));
  }
  out.files = {{"dempster.png", png(draw_map_of(dempster, room, false))},
               {"bayes.png", png(draw_map_of(bayes, room, false))},
               {"dempster_ways.png", png(draw_map_of(dempster, room, true))},
               {"bayes_ways.png", png(draw_map_of(bayes, room, true))}};

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
  page.heading("Surfaces that throw sound away");
  page.paragraph(
      "The paper's readings are simulated, and its text tells of no lost echoes, so the room above echoes at every "
      "slant. Here everything that stands throws sound away beyond one critical incidence, the same way and noise. "
      "Dempster / Bayes.");
  page.table({"critical incidence, degrees", "routes with a way", "least clearance, m", "mean clearance, m",
              "off the ideal map"},
             slanting.rows);
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
