// SPDX-License-Identifier: Apache-2.0
#include "paper/li2014/cycle_findings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "paper/li2014/report.hpp"

namespace evigrid::driver {

void GermTally::add(const GermRun& run) {
  ++runs;
  walls += run.touched_walls, movers += run.touched_mover, plans += run.plans, avoided += run.avoided;
  cycles += run.cycle_ms.size();
  for (const double ms : run.cycle_ms) most_ms = std::max(most_ms, ms), sum_ms += ms, late += ms > kCycle_ms;
}

std::vector<Finding> cycle_findings(const GermTally& t, Aim cycle_aim) {
  return {{"plans a run, cycles of the avoid agent",
           "A* only occasionally; avoid usually not needed",
           fmt::format("{:.1f} plans in {:.0f} cycles, {:.1f} avoiding", ratio(t.plans, t.runs),
                       ratio(t.cycles, t.runs), ratio(t.avoided, t.runs)),
           Aim::reported,
           false,
           "planned when an echo lies in the guard district, radius + 2 cm on either side of the way",
           {t.plans, t.cycles, t.avoided}},
          {"cycles in which the body touched a wall, the other robot",
           "none",
           fmt::format("{}, {}", t.walls, t.movers),
           Aim::reported,
           false,
           "all runs of the agents; the other robot does not look where it goes",
           {t.walls, t.movers}},
          {"cycles above 100 ms",
           "the system works without lags",
           fmt::format("{} of {}; {:.1f} ms at most, {:.2f} on average", t.late, t.cycles, t.most_ms,
                       t.sum_ms / static_cast<double>(std::max<std::size_t>(t.cycles, 1))),
           cycle_aim,
           t.late == 0,
           "perception, localization, planning, behaviour and map of a cycle; the simulator left out",
           {t.late, t.cycles, t.most_ms},
           true}};
}

Finding cycle_kept(const std::string& name, double most_ms, double mean_ms, Aim aim) {
  return {name,
          "100 ms",
          fmt::format("{:.2f} ms at most, {:.2f} on average", most_ms, mean_ms),
          aim,
          most_ms < kCycle_ms,
          "fusion of one scan of 16 sonars",
          {most_ms, mean_ms},
          true};
}

}  // namespace evigrid::driver
