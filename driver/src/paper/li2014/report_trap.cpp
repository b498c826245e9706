// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "paper/li2014/cycle_findings.hpp"
#include "paper/li2014/report.hpp"
#include "picture/map_picture.hpp"
#include "progress.hpp"

namespace evigrid::driver {
namespace {

constexpr raycast::Point kGoal{4.2, 1.6};

}  // namespace

void add_trap(PaperResult& out, const PaperOptions& o) {
  const PaperWorld world(paper_scene({.seed = o.seed}, "li2014_utrap", "pioneer16"));
  const std::size_t seeds = o.quick ? 2 : 20;
  std::vector<GermRun> agents, field;
  Progress progress("leaving the trap");
  for (std::size_t i = 0; i < seeds; ++i) {
    GermOptions options{
        .goal = kGoal, .seed = world.scene.trajectory.seed + i, .threads = o.threads, .keep_map = i == 0};
    agents.push_back(run_germ(world, options));
    options.steering = Steering::potential_field;
    field.push_back(run_germ(world, options));
    progress.show(i + 1, seeds);
  }
  const auto reached = [](const std::vector<GermRun>& runs) {
    return static_cast<std::size_t>(
        std::count_if(runs.begin(), runs.end(), [](const GermRun& r) { return r.reached; }));
  };
  GermTally tally;
  double way = 0, longest = 0;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < seeds; ++i) {
    const GermRun &a = agents[i], &f = field[i];
    tally.add(a);
    way += a.way_m / static_cast<double>(seeds);
    longest = std::max(longest, a.way_m);
    rows.push_back({std::to_string(world.scene.trajectory.seed + i), a.reached ? "reached" : "not reached",
                    fmt::format("{:.1f}", a.time_s), fmt::format("{:.2f}", a.way_m), std::to_string(a.plans),
                    std::to_string(a.without_way), std::to_string(a.avoided),
                    fmt::format("{} / {}", a.touched_walls, a.touched_mover), f.reached ? "reached" : "trapped",
                    fmt::format("{:.2f}, {:.2f}", f.poses.back().x_m, f.poses.back().y_m)});
  }
  const std::string how =
      fmt::format("{} seeds of the noise of sonars and wheels; each run ends at the goal or after 150 s", seeds);
  out.findings.push_back({"runs in which the planner leaves the U-trap and reaches the goal",
                          "leaves it easily",
                          fmt::format("{} of {}", reached(agents), seeds),
                          Aim::target,
                          reached(agents) == seeds,
                          how,
                          {reached(agents), seeds}});
  out.findings.push_back({"runs in which the potential field alone does",
                          "trapped",
                          fmt::format("{} of {}", reached(field), seeds),
                          Aim::target,
                          reached(field) == 0,
                          how,
                          {reached(field), seeds}});
  out.findings.push_back({"way of the agents",
                          "",
                          fmt::format("{:.2f} m on average, {:.2f} m at most", way, longest),
                          Aim::fact,
                          false,
                          "the same runs",
                          {way, longest}});
  for (Finding& f : cycle_findings(tally, Aim::target)) out.findings.push_back(std::move(f));
  Page& page = out.page;
  page.heading("Out of the U-shaped trap");
  page.begin_row();
  for (const auto& [r, name, file] : {std::tuple{&agents[0], "agents: the first run", "trap_agents.png"},
                                      {&field[0], "potential field alone: the first run", "trap_field.png"}}) {
    out.files.push_back(
        {file, png(draw_map(r->layers, r->poses, {name, "true way on the map at the end"}, {.name = file}))});
    page.picture(out.files.back().bytes, name);
  }
  page.end_row();
  page.table({"seed", "agents", "time, s", "way, m", "plans", "cycles without a way", "cycles avoiding",
              "touched wall / mover", "field alone", "where it ends"},
             rows);
}

}  // namespace evigrid::driver
