// SPDX-License-Identifier: Apache-2.0
#include "paper/li2014/germ_robot.hpp"

#include <algorithm>
#include <numbers>

#include "evigrid/scenes/live.hpp"
#include "mapping.hpp"
#include "options.hpp"
#include "paper/li2014/heading.hpp"
#include "paper/li2014/potential_field.hpp"
#include "paper/li2014/walkers.hpp"
#include "paper/points.hpp"

namespace evigrid::driver {
namespace {

constexpr double kCycle_s = 0.1;
constexpr double kDone_m = 0.1;          // from the goal
constexpr double kTurningGoal_m = 0.08;  // where a turning goal counts as reached
constexpr double kAhead_s = 0.5;         // how far ahead the avoid agent looks
constexpr double kTooNear_m = 0.01;      // from the rim, within that time

double direction(raycast::Point from, raycast::Point to) { return std::atan2(to.y_m - from.y_m, to.x_m - from.x_m); }

/// The goto agent: straight for the turning goal, and into the next leg before the corner is reached.
Drive go_to(raycast::Point target, const scenes::Pose& at, const DriveLimits& limits) {
  Drive d = towards(direction(place(at), target), at.yaw_rad, limits);
  d.speed_m_s = std::min(d.speed_m_s, distance(place(at), target) / kCycle_s);
  return d;
}

/// Whether the body would come too near an echo if the goto agent had its way for a while: then the avoid agent's
/// claim is the stronger one, and it gets the motors. Echoes that the motion leads away from do not count.
bool avoid_wins(const Drive& wanted, const std::vector<raycast::Point>& echoes, const scenes::Pose& at,
                double radius_m) {
  const scenes::Pose next = scenes::advance(at, wanted.speed_m_s * kAhead_s, wanted.turn_rate_rad_s * kAhead_s);
  return std::any_of(echoes.begin(), echoes.end(), [&](raycast::Point e) {
    const double then = distance(e, place(next));
    return then < radius_m + kTooNear_m && then < distance(e, place(at));
  });
}

/// The avoid agent: along the force of the field; on the spot while what pushes is ahead.
Drive avoid(const std::vector<raycast::Point>& heard, raycast::Point target, const scenes::Pose& at, double radius_m,
            const DriveLimits& limits) {
  const raycast::Point f = force(heard, place(at), target, radius_m);
  return towards(std::atan2(f.y_m, f.x_m), at.yaw_rad, limits);
}

}  // namespace

MapParams germ_params(const scenes::Scene& scene) {
  MapParams params;
  params.cell_m = scene.map.cell_m;
  params.rule = parse_map_rule(scene.map.rule);
  params.false_reflection_m = scene.map.false_reflection_m;
  return params;
}

GermRun run_germ(const PaperWorld& world, const GermOptions& o) {
  scenes::Scene scene = world.scene;
  scene.trajectory.seed = o.seed;
  scenes::LiveRobot robot(*world.floor, *world.caster, scene, scene.trajectory.start.value_or(scenes::Pose{}));
  const Walkers walkers(scene);
  const FieldRect field = field_of(scene);
  const MapParams params = germ_params(scene);
  const auto executor = parse_executor("tbb", o.threads);
  RobotMap mapped(scene, params, executor);
  HeadingAgent localization(scene, params, field, executor);
  PathAgent planning(field, {.radius_m = scene.radius_m});
  const DriveLimits limits{scene.trajectory.speed_m_s, scene.trajectory.turn_rate_rad_s};
  GermRun run;
  const bool agents = o.steering == Steering::agents;
  std::size_t lost = 0;  // cycles without a way, one after the other
  for (double t = 0; t <= o.limit_s; t = static_cast<double>(run.poses.size()) * kCycle_s) {
    const auto movers = walkers.at(t);
    const scenes::Sensed scan = robot.sense(movers);
    const auto begin = Clock::now();
    if (scene.odometry.used && !run.poses.empty()) {
      scenes::Pose turned = robot.believed();
      turned.yaw_rad += localization.error_of(mapped.map, scan, turned);
      robot.correct(turned);
    }
    const scenes::Pose at = robot.believed();
    mapped.fuse(scan, at, t);
    const std::vector<raycast::Point> heard = echoes(scene, scan.ranges_m, at);
    Drive drive;
    if (agents) {
      (void)planning.next_goal(place(at), kTurningGoal_m);
      if (planning.needs_plan(heard, place(at))) {
        ++run.plans;
        if (!planning.plan(mapped.map, place(at), o.goal)) ++run.without_way;
      }
      lost = planning.turning_goals().empty() ? lost + 1 : 0;
      const auto target = planning.next_goal(place(at), kTurningGoal_m);
      if (target) {
        if (run.goals.empty() || distance(run.goals.back(), *target) > field.cell_m) run.goals.push_back(*target);
        drive = go_to(*target, at, limits);
      }
      if (!target || avoid_wins(drive, heard, at, scene.radius_m)) {
        ++run.avoided;
        drive = avoid(heard, target.value_or(o.goal), at, scene.radius_m, limits);
      }
    } else {
      drive = avoid(heard, o.goal, at, scene.radius_m, limits);
    }
    run.cycle_ms.push_back(1e3 * seconds_since(begin));
    run.poses.push_back(to_engine(robot.pose()));
    run.reached = distance(place(at), o.goal) <= kDone_m;
    run.time_s = t;
    if (run.reached || static_cast<double>(lost) * kCycle_s >= o.give_up_s) break;
    run.touched_walls += robot.move(scenes::Motion{kCycle_s, drive.speed_m_s, drive.turn_rate_rad_s}).stopped;
    for (std::size_t i = 0; i < movers.size(); ++i) {
      for (const raycast::Circle& c : scene.movers[i].shape.circles) {
        const scenes::Pose p = scenes::compose(scenes::Pose{movers[i].x_m, movers[i].y_m, movers[i].yaw_rad},
                                               scenes::Pose{c.centre.x_m, c.centre.y_m, 0});
        run.touched_mover += distance(place(robot.pose()), place(p)) < scene.radius_m + c.radius_m;
      }
    }
  }
  run.way_m = robot.way_m();
  run.pose_error_m = distance(place(robot.believed()), place(robot.pose()));
  if (o.keep_map) run.layers = render_layers(mapped.map, field.rect, "map", 512);
  return run;
}

}  // namespace evigrid::driver
