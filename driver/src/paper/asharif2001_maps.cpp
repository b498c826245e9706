// SPDX-License-Identifier: Apache-2.0
#include "paper/asharif2001_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "error.hpp"
#include "evigrid/scenes/simulate.hpp"
#include "mapping.hpp"
#include "paper/robot_map.hpp"
#include "score/truth.hpp"
#include "simulated.hpp"

namespace evigrid::driver::asharif2001 {
namespace {

/// Section 5, in cells of the paper's map: P1 … P8.
constexpr std::array<std::pair<GridCell, GridCell>, 8> kRoutes{{{{20, 20}, {120, 180}},
                                                                {{20, 180}, {120, 20}},
                                                                {{20, 20}, {80, 80}},
                                                                {{120, 180}, {80, 80}},
                                                                {{20, 180}, {80, 80}},
                                                                {{120, 20}, {80, 80}},
                                                                {{80, 20}, {80, 80}},
                                                                {{80, 180}, {80, 80}}}};

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

}  // namespace

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

}  // namespace evigrid::driver::asharif2001
