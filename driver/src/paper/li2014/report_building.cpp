// SPDX-License-Identifier: Apache-2.0
// Li et al. 2014 in a building of the user's: what of the paper makes sense there, under the same names.
#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"
#include "paper/agreement.hpp"
#include "paper/li2014/building.hpp"
#include "paper/li2014/building_tour.hpp"
#include "paper/li2014/cycle_findings.hpp"
#include "paper/li2014/report.hpp"
#include "paper/li2014/report_errands.hpp"
#include "paper/plan_part.hpp"
#include "paper/plan_picture.hpp"
#include "picture/map_picture.hpp"

namespace evigrid::driver {
namespace {

constexpr double kHeadingWay_m = 12;
constexpr std::size_t kQuickScans = 400;

const std::vector<double> kErrands_m{5, 10, 20, 40}, kQuickErrands_m{8};

struct LeftOut {
  std::string what, why;
};

void add_tour(PaperResult& out, const PaperWorld& building, const TourRun& run) {
  const TourMap &dsmt = run.maps[0], &dst = run.maps[1];
  const auto both = [&](auto member) { return fmt::format("DSmT {:.3f}, Dempster {:.3f}", member(dsmt), member(dst)); };
  const auto add = [&](const char* name, const char* how, auto member) {
    out.findings.push_back({name, "", both(member), Aim::fact, false, how, {member(dsmt), member(dst)}});
  };
  const std::string how =
      fmt::format("{} scans along a tour through all that the robot can reach, nobody in the building", run.way.size());
  add("the building: precision", "of the cells called occupied: share with a true wall within one cell",
      [](const TourMap& m) { return m.score.near.precision; });
  add("the building: recall", "of the true walls that border free space: share called occupied within one cell",
      [](const TourMap& m) { return m.score.near.recall; });
  add("the building: mistaken rate", "of the decided cells: share called what they are not, one cell forgiven",
      [](const TourMap& m) { return m.score.near.mistaken_rate; });
  out.findings.push_back(cycle_kept("the cycle of 100 ms is kept while mapping the building", dsmt.most_cycle_ms,
                                    dsmt.mean_cycle_ms, Aim::reported));
  Page& page = out.page;
  page.heading("The building, mapped");
  page.paragraph(how + fmt::format(". Cells of {:g} cm.", 100 * building.scene.map.cell_m));
  page.begin_row();
  for (const TourMap& m : run.maps) {
    const bool first = m.rule == Rule::germ_pcr2;
    const std::string file = first ? "building_dsmt.png" : "building_dempster.png",
                      title = first ? "DSmT: the building after the tour" : "Dempster: the building after the tour";
    out.files.push_back({file, png(draw_map(m.layers, run.way, {title, "cells of 5 cm"}, {.name = file}))});
    page.picture(out.files.back().bytes, title);
  }
  page.end_row();
  const MetricTable metrics = metric_table(
      {{"DSmT", dsmt.score, mean_conflict(dsmt.layers)}, {"Dempster", dst.score, mean_conflict(dst.layers)}});
  page.table(metrics.head, metrics.rows);
}

void add_places(PaperResult& out, const PaperWorld& building, const std::optional<Patrol>& patrol,
                const std::vector<Errand>& errands) {
  std::vector<PlanDrawn> drawn{{"the tour", building.scene.trajectory.waypoints, {150, 190, 220}}};
  if (patrol) {
    drawn.push_back({"the patrol", patrol->stretch, kPath});
    drawn.push_back({"where the person walks", {patrol->walk[0], patrol->walk[1]}, kThingColour});
    for (const raycast::Box& b : patrol->things) {
      const auto at = corners(b);
      drawn.push_back({"", {at[0], at[1], at[2], at[3], at[0]}, kThingColour});
    }
  }
  PlanDrawn ends{"start and goals", {building.scene.trajectory.waypoints.front()}, kStart, false};
  for (const Errand& e : errands) {
    drawn.push_back({&e == errands.data() ? "shortest ways to the goals" : "", e.shortest, kGoalColour});
    ends.points.push_back(e.goal);
  }
  drawn.push_back(std::move(ends));
  out.files.push_back(
      {"places.png", png(draw_plan(building.scene, {"where what takes place", building.scene.name}, drawn))});
  out.page.heading("Where what takes place");
  out.page.picture(out.files.back().bytes, "The plan, and the places chosen in it.");
}

}  // namespace

PaperResult li2014_in_building(const PaperOptions& o) {
  const auto page = [] {
    return Page("A robot of agents in a building",
                "P. Li, X. Huang, S. Wang, J. Dezert: SLAM and path planning of mobile robot using DSmT. 2014.");
  };
  PaperResult out{page(), {}};
  const PaperWorld building(building_scene(o, "li2014", kBuildingCell_m));
  PlanWays ways(building.scene);
  const std::vector<Errand> errands = find_errands(building.scene, ways, o.quick ? kQuickErrands_m : kErrands_m);
  if (errands.empty())
    throw InputError(o.world + ": the robot has nowhere to go: all that it can reach lies within a metre");
  const std::optional<Patrol> patrol = find_patrol(building);
  const TourRun tour = map_tour(building, o.world, o.quick ? kQuickScans : SIZE_MAX, o.threads);
  std::vector<LeftOut> left_out{
      {"the U-trap", "is a board in the paper's room; a building has no such trap at a known place"},
      {"tables 1 to 3, the learned revision and 50 000 groups in a cycle",
       "are about rules, model and sensor, not about a room: run the paper without --world"}};
  add_places(out, building, patrol, errands);
  add_tour(out, building, tour);
  if (patrol) {
    add_dynamic_room(out, o, PaperWorld(patrol_scene(building.scene, *patrol)));
    if (patrol->things.size() < 2)
      left_out.push_back(
          {patrol->things.empty() ? "A and B" : "B", "nowhere beside the tour is there room for it near the person"});
  } else {
    left_out.push_back({"the walking person, A and B", "nowhere beside the tour is there room for a person to walk"});
  }
  const PaperWorld drifting(building_scene(o, "li2014_drift", kPlaceCell_m));
  add_heading(out, o, PaperWorld(stretch_scene(drifting, o.quick ? 8 : kHeadingWay_m, !o.start.empty())));
  add_errands(out, o, building_scene(o, "li2014_utrap", kBuildingCell_m), errands);

  Page whole = page();
  whole.paragraph(fmt::format(
      "The paper's Pioneer with 16 sonars, agents and cycle of 100 ms, in the plan {}. This is not the paper's room: "
      "its "
      "published figures do not apply here and are not aimed at, the same behaviours are shown in another building.",
      o.world));
  whole.findings(out.findings);
  whole.append(out.page);
  whole.heading("Left out here");
  std::vector<std::string> lines;
  nlohmann::ordered_json told = nlohmann::ordered_json::array();
  for (const LeftOut& l : left_out) {
    lines.push_back(l.what + ": " + l.why + ".");
    told.push_back({{"what", l.what}, {"why", l.why}});
  }
  whole.list(lines);
  whole.heading("What the text leaves open");
  whole.list(
      {fmt::format(
           "Cells of {:g} cm for what spans the building, of {:g} cm around one place; the paper's room has 1 cm.",
           100 * kBuildingCell_m, 100 * kPlaceCell_m),
       "The tour: through all that the robot can reach, from the widest place or from --start.",
       "The patrol: the first 4 m of the tour with room beside them for a person who walks to and fro over 1.2 m and "
       "for "
       "two things as large as A and B; driven to and fro twice.",
       "The goals: of the places of the tour those farthest by way within 5, 10, 20 and 40 m. Where there is room "
       "another "
       "robot crosses the shortest way near its middle.",
       "All else as in the paper's own room: run without --world, the page says it."});
  out.details["left_out"] = std::move(told);
  out.page = std::move(whole);
  return out;
}

}  // namespace evigrid::driver
