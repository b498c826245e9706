// SPDX-License-Identifier: Apache-2.0
#include "paper/li2014/report_errands.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "paper/li2014/cycle_findings.hpp"
#include "paper/li2014/report.hpp"
#include "picture/map_picture.hpp"
#include "progress.hpp"

namespace evigrid::driver {
namespace {

constexpr double kPatience = 3, kMore_s = 60;  // times the shortest way's time, and more
constexpr double kGiveUp_s = 10;               // with a map that leaves no way

struct Run {
  GermRun agents, field;
  double shortest_m;
  bool crossed;
};

Run run_errand(const PaperOptions& o, scenes::Scene scene, const Errand& errand, std::uint64_t number) {
  const double shortest_m = length_of(errand.shortest);
  const PaperWorld empty(scene);
  const auto other = crossing_robot(empty, errand);
  if (other) scene.movers = {*other};
  const raycast::Point from = errand.shortest.front(), next = errand.shortest.at(1);
  if (!scene.trajectory.start)
    scene.trajectory.start = scenes::Pose{from.x_m, from.y_m, std::atan2(next.y_m - from.y_m, next.x_m - from.x_m)};
  const PaperWorld world(std::move(scene));
  GermOptions options{.goal = errand.goal,
                      .limit_s = kPatience * shortest_m / world.scene.trajectory.speed_m_s + kMore_s,
                      .give_up_s = kGiveUp_s,
                      .seed = world.scene.trajectory.seed + number,
                      .threads = o.threads,
                      .keep_map = true};
  Run run{run_germ(world, options), {}, shortest_m, other.has_value()};
  options.steering = Steering::potential_field;
  options.keep_map = false;
  run.field = run_germ(world, options);
  return run;
}

}  // namespace

void add_errands(PaperResult& out, const PaperOptions& o, const scenes::Scene& building,
                 const std::vector<Errand>& errands) {
  std::vector<Run> runs;
  {
    Progress progress("driving to goals");
    for (std::size_t i = 0; i < errands.size(); ++i) {
      runs.push_back(run_errand(o, building, errands[i], i));
      progress.show(i + 1, errands.size());
    }
  }
  GermTally tally;
  std::size_t reached = 0, field_reached = 0;
  double longer = 0;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const GermRun &a = runs[i].agents, &f = runs[i].field;
    reached += a.reached, field_reached += f.reached;
    tally.add(a);
    if (a.reached) longer = std::max(longer, a.way_m / runs[i].shortest_m);
    rows.push_back({fmt::format("{:.2f}, {:.2f}", errands[i].goal.x_m, errands[i].goal.y_m),
                    fmt::format("{:.1f}", runs[i].shortest_m), a.reached ? "reached" : "not reached",
                    fmt::format("{:.1f}", a.time_s), fmt::format("{:.1f}", a.way_m), std::to_string(a.plans),
                    std::to_string(a.without_way), std::to_string(a.avoided), runs[i].crossed ? "yes" : "no room",
                    fmt::format("{} / {}", a.touched_walls, a.touched_mover), f.reached ? "reached" : "stuck",
                    fmt::format("{:.2f}, {:.2f}", f.poses.back().x_m, f.poses.back().y_m)});
  }
  const std::string how = fmt::format(
      "{} goals, the plan unknown to the robot; a run ends at the goal or after three "
      "times the shortest way's time and a minute",
      runs.size());
  out.findings.push_back({"goals that the planner reaches",
                          "reaches the goal",
                          fmt::format("{} of {}", reached, runs.size()),
                          Aim::reported,
                          false,
                          how,
                          {reached, runs.size()}});
  out.findings.push_back({"goals that the potential field alone reaches",
                          "trapped",
                          fmt::format("{} of {}", field_reached, runs.size()),
                          Aim::reported,
                          false,
                          how,
                          {field_reached, runs.size()}});
  out.findings.push_back({"the way driven, as a multiple of the shortest one", "",
                          reached == 0 ? std::string("none") : fmt::format("{:.2f} at most", longer), Aim::fact, false,
                          "of the goals reached; the shortest way is that of one who knows the plan", longer});
  for (Finding& f : cycle_findings(tally, Aim::reported)) out.findings.push_back(std::move(f));
  Page& page = out.page;
  page.heading("To goals in the building");
  page.paragraph(
      "Where a goal is missed, the map closes what is open: an echo fills the width of its cone, 0.26 of the range, "
      "and "
      "the model's wall begins before it (by 22 % at 1 m), so that a door seen from afar is a wall. The planner holds "
      "what "
      "is unknown for free: rather than come nearer, it goes round by where it has not been, until nothing is left.");
  page.begin_row();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string file = fmt::format("goal{}.png", i + 1), title = fmt::format("agents: to goal {}", i + 1);
    out.files.push_back({file, png(draw_map(runs[i].agents.layers, runs[i].agents.poses,
                                            {title, "true way on the map at the end"}, {.name = file}))});
    page.picture(out.files.back().bytes, title);
  }
  page.end_row();
  page.table({"goal, m", "shortest way, m", "agents", "time, s", "way, m", "plans", "cycles without a way",
              "cycles avoiding", "crossed by another robot", "touched wall / mover", "field alone", "where it ends"},
             rows);
}

}  // namespace evigrid::driver
