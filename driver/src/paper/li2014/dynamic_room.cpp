// SPDX-License-Identifier: Apache-2.0
#include "paper/li2014/dynamic_room.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "error.hpp"
#include "evigrid/scenes/simulate.hpp"
#include "mapping.hpp"
#include "options.hpp"
#include "paper/li2014/field.hpp"
#include "paper/li2014/germ_robot.hpp"
#include "paper/li2014/path_agent.hpp"
#include "paper/points.hpp"
#include "paper/robot_map.hpp"
#include "score/truth.hpp"

namespace evigrid::driver {
namespace {

constexpr double kNear_m = 0.05;     // between a thing's outline and a cell that shows it
constexpr double kEcho_m = 0.06;     // between a reading and the leg that gave it
constexpr double kGone_m = 0.15;     // a place is left when the person is farther than this from it
constexpr double kOutline_m = 0.01;  // between two points of an outline

std::vector<raycast::Point> outline(const raycast::Box& b) {
  std::vector<raycast::Point> out;
  const std::array<raycast::Point, 4> corner{{{b.length_m / 2, b.width_m / 2},
                                              {-b.length_m / 2, b.width_m / 2},
                                              {-b.length_m / 2, -b.width_m / 2},
                                              {b.length_m / 2, -b.width_m / 2}}};
  for (std::size_t side = 0; side < 4; ++side) {
    const raycast::Point from = corner[side], to = corner[(side + 1) % 4];
    const int n = static_cast<int>(std::ceil(distance(from, to) / kOutline_m));
    for (int i = 0; i < n; ++i) {
      const double t = static_cast<double>(i) / n;
      out.push_back(place(
          scenes::compose(scenes::Pose{b.centre.x_m, b.centre.y_m, b.yaw_rad},
                          scenes::Pose{from.x_m + t * (to.x_m - from.x_m), from.y_m + t * (to.y_m - from.y_m), 0})));
    }
  }
  return out;
}

std::vector<raycast::Circle> legs(const scenes::MoverSpec& person, const raycast::Placement& at) {
  std::vector<raycast::Circle> out;
  for (const raycast::Circle& c : person.shape.circles) {
    const scenes::Pose p =
        scenes::compose(scenes::Pose{at.x_m, at.y_m, at.yaw_rad}, scenes::Pose{c.centre.x_m, c.centre.y_m, 0});
    out.push_back({place(p), c.radius_m, {}});
  }
  return out;
}

/// The legs that gave an echo in this scan.
std::vector<raycast::Circle> seen(const scenes::Scene& scene, const scenes::Step& step,
                                  const std::vector<raycast::Circle>& legs) {
  std::vector<raycast::Circle> out;
  for (const raycast::Circle& leg : legs) {
    for (std::size_t i = 0; i < scene.sonars.size(); ++i) {
      const double r = step.ranges_m[i];
      if (!std::isfinite(r)) continue;
      const scenes::Pose s = compose(step.T_map_robot, scene.sonars[i].T_robot_sensor);
      const double d = distance(place(s), leg.centre);
      const double off = std::abs(
          std::remainder(std::atan2(leg.centre.y_m - s.y_m, leg.centre.x_m - s.x_m) - s.yaw_rad, 2 * std::numbers::pi));
      const bool in_cone = off <= scene.sonars[i].aperture_rad / 2 + std::asin(std::min(1.0, leg.radius_m / d));
      if (in_cone && std::abs(d - leg.radius_m - r) < kEcho_m) {
        out.push_back(leg);
        break;
      }
    }
  }
  return out;
}

/// Cells called occupied whose centre is within kNear_m of the circle or in it.
std::vector<GridCell> occupied_at(const Map& map, const FieldRect& field, const raycast::Circle& c) {
  const double reach = c.radius_m + kNear_m;
  const GridCell low = field.cell({c.centre.x_m - reach, c.centre.y_m - reach}),
                 high = field.cell({c.centre.x_m + reach, c.centre.y_m + reach});
  const CellRect rect{field.rect.x + low.x, field.rect.y + low.y, high.x - low.x + 1, high.y - low.y + 1};
  std::vector<float> decision(static_cast<std::size_t>(rect.width * rect.height));
  map.render(Layer::decision, rect, decision, rect.width);
  std::vector<GridCell> out;
  for (std::size_t i = 0; i < decision.size(); ++i) {
    const GridCell g{low.x + static_cast<int>(i % static_cast<std::size_t>(rect.width)),
                     low.y + static_cast<int>(i / static_cast<std::size_t>(rect.width))};
    if (decision[i] == 1 && distance(field.centre(g), c.centre) <= reach) out.push_back(g);
  }
  return out;
}

double outline_shown(const std::vector<std::uint8_t>& occupied, const FieldRect& field, const raycast::Box& box) {
  const int reach = static_cast<int>(std::lround(kNear_m / field.cell_m));
  const auto points = outline(box);
  const auto shown = std::count_if(points.begin(), points.end(), [&](raycast::Point p) {
    const GridCell c = field.cell(p);
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const GridCell g{c.x + dx, c.y + dy};
        if (field.inside(g) && occupied[field.index(g)] != 0 && distance(field.centre(g), p) <= kNear_m) return true;
      }
    }
    return false;
  });
  return static_cast<double>(shown) / static_cast<double>(points.size());
}

}  // namespace

std::string RoomMapping::name() const {
  const char* of = rule == Rule::germ_pcr2 ? "DSmT" : "Dempster";
  return reliability == 1 ? std::string(of) : fmt::format("{}, reliability {:g}", of, reliability);
}

RoomRun map_dynamic_room(const PaperWorld& world, const std::vector<RoomMapping>& mappings, bool quick, int threads) {
  const scenes::Simulation simulation(world.scene, *world.caster);
  const std::size_t scans = quick ? std::min<std::size_t>(simulation.steps(), 500) : simulation.steps();
  const std::vector<scenes::Step> steps = simulation.run(0, scans, threads);
  const scenes::MoverSpec& person = world.scene.movers.at(0);
  const FieldRect field = field_of(world.scene);
  const SceneTruth truth = scene_truth(world.scene, world.scene.map.cell_m);
  if (!truth.grid) throw InputError("the true room: " + truth.why_not);
  std::size_t halfway = scans / 2;  // from there on the first scan that hears the person
  while (halfway + 1 < scans &&
         seen(world.scene, steps[halfway], legs(person, simulation.movers_at(halfway)[0])).empty())
    ++halfway;
  RoomRun run;
  for (const scenes::Step& s : steps) run.way.push_back(to_engine(s.T_map_robot));
  run.person_halfway = simulation.movers_at(halfway)[0];
  for (const RoomMapping& m : mappings) {
    scenes::Scene scene = world.scene;
    for (scenes::SonarSpec& s : scene.sonars) s.reliability = m.reliability;
    MapParams params = germ_params(scene);
    params.rule = m.rule;
    RobotMap mapped(scene, params, parse_executor("tbb", threads));
    RoomResult out;
    out.mapping = m;
    std::set<std::size_t> for_person;  // cells once called occupied for it
    for (std::size_t i = 0; i < scans; ++i) {
      const auto begin = Clock::now();
      const Report report = mapped.fuse({steps[i].ranges_m, {}}, steps[i].T_map_robot, 0.1 * static_cast<double>(i));
      const double ms = 1e3 * seconds_since(begin);
      out.mean_cycle_ms += ms / static_cast<double>(scans);
      out.most_cycle_ms = std::max(out.most_cycle_ms, ms);
      out.most_cells = std::max(out.most_cells, report.cells_updated);
      const auto heard = seen(scene, steps[i], legs(person, simulation.movers_at(i)[0]));
      bool shown = false;
      for (const raycast::Circle& leg : heard) {
        for (const GridCell g : occupied_at(mapped.map, field, leg)) {
          for_person.insert(field.index(g));
          shown = true;
        }
      }
      out.person_seen += !heard.empty();
      out.person_shown += shown;
      if (i == halfway) out.halfway = render_layers(mapped.map, field.rect, "map", 512);
    }
    out.layers = render_layers(mapped.map, field.rect, "map", 512);
    const auto now = legs(person, simulation.movers_at(scans - 1)[0]);
    for (const std::size_t cell : for_person) {
      const GridCell g{static_cast<int>(cell % static_cast<std::size_t>(field.rect.width)),
                       static_cast<int>(cell / static_cast<std::size_t>(field.rect.width))};
      const bool still = std::any_of(now.begin(), now.end(), [&](const raycast::Circle& leg) {
        return distance(field.centre(g), leg.centre) <= leg.radius_m + kGone_m;
      });
      if (still) continue;
      ++out.left;
      const Decision d = decide(out.layers.e()[cell], out.layers.o()[cell], out.layers.u()[cell]);
      out.left_empty += d == Decision::empty;
      out.left_occupied += d == Decision::occupied;
    }
    const auto occupied = occupied_cells(mapped.map, field);
    for (const raycast::Box& box : scene.world.boxes) out.object_shown.push_back(outline_shown(occupied, field, box));
    out.score = score(out.layers, *truth.grid);
    run.results.push_back(std::move(out));
  }
  return run;
}

}  // namespace evigrid::driver
