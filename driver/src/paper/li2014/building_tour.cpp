// SPDX-License-Identifier: Apache-2.0
#include "paper/li2014/building_tour.hpp"

#include <algorithm>
#include <cmath>

#include "error.hpp"
#include "evigrid/scenes/simulate.hpp"
#include "mapping.hpp"
#include "options.hpp"
#include "paper/li2014/field.hpp"
#include "paper/li2014/germ_robot.hpp"
#include "paper/robot_map.hpp"
#include "progress.hpp"
#include "score/truth.hpp"

namespace evigrid::driver {

TourRun map_tour(const PaperWorld& building, const std::string& plan, std::size_t most_scans, int threads) {
  const SceneTruth truth = scene_truth(building.scene, building.scene.map.cell_m);
  if (!truth.grid) throw InputError(plan + ": " + truth.why_not);
  const scenes::Simulation simulation(building.scene, *building.caster);
  const std::vector<scenes::Step> steps = simulation.run(0, std::min(most_scans, simulation.steps()), threads);
  TourRun run;
  for (const scenes::Step& s : steps) {
    run.way.push_back(to_engine(s.T_map_robot));
    run.echoes += static_cast<std::size_t>(
        std::count_if(s.ranges_m.begin(), s.ranges_m.end(), [](float r) { return std::isfinite(r); }));
  }
  if (run.echoes == 0 && steps.size() == simulation.steps())
    throw InputError(plan + ": no sonar hears anything on a tour of the plan: it is too open");
  const FieldRect field = field_of(building.scene);
  Progress progress("mapping the building");
  for (const Rule rule : {Rule::germ_pcr2, Rule::dempster}) {
    scenes::Scene scene = building.scene;
    for (scenes::SonarSpec& s : scene.sonars) s.reliability = 1;
    MapParams params = germ_params(scene);
    params.rule = rule;
    RobotMap mapped(scene, params, parse_executor("tbb", threads));
    TourMap out;
    out.rule = rule;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const auto begin = Clock::now();
      mapped.fuse({steps[i].ranges_m, {}}, steps[i].T_map_robot, static_cast<double>(steps[i].stamp_ns) * 1e-9);
      const double ms = 1e3 * seconds_since(begin);
      out.mean_cycle_ms += ms / static_cast<double>(steps.size());
      out.most_cycle_ms = std::max(out.most_cycle_ms, ms);
      progress.show(run.maps.size() * steps.size() + i + 1, 2 * steps.size());
    }
    out.layers = render_layers(mapped.map, field.rect, "map", 2048);
    out.score = score(out.layers, *truth.grid);
    run.maps.push_back(std::move(out));
  }
  return run;
}

}  // namespace evigrid::driver
