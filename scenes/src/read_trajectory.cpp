// SPDX-License-Identifier: Apache-2.0
// [trajectory]: waypoints, [[trajectory.velocity]] legs, or kind = "tour" through everything that can be reached. The
// number of steps is bounded before any is made.
#include <cmath>
#include <limits>

#include "evigrid/scenes/tour.hpp"
#include "read.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::size_t kMostSteps = 1'000'000, kMostLegs = 100'000;
constexpr double kLongestLeg_s = 1e7;

/// Not less than what the route takes: a turn is at most half a circle.
double longest_s(const TrajectorySpec& run) {
  double time_s = 0;
  for (std::size_t i = 0; i < run.waypoints.size(); ++i) {
    const raycast::Point& b = run.waypoints[i];
    raycast::Point a = b;
    if (i > 0) a = run.waypoints[i - 1];
    if (i == 0 && run.start) a = {run.start->x_m, run.start->y_m};
    time_s += std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) / run.speed_m_s + 3.15 / run.turn_rate_rad_s;
  }
  for (const Motion& leg : run.legs) time_s += leg.duration_s;
  return time_s;
}

/// Sets the waypoints, and the start where one is given: the tour does not ask for its yaw, the robot faces it.
void plan_tour(Table& t, const Scene& scene, const SceneLimits& limits, TrajectorySpec& run) {
  TourSpec tour;
  tour.most_cells = limits.most_tour_cells;
  tour.clearance_m = t.number_or("clearance_m", {0, 100, true}, scene.radius_m + 0.05);
  tour.spacing_m = t.number_or("spacing_m", {0.1, 1000}, tour.spacing_m);
  try {
    if (t.has("start")) {
      const Pose start = t.pose("start");
      tour.start = {start.x_m, start.y_m};
      run.start = start;
    } else {
      tour.start = find_start(scene.world, tour.clearance_m, tour.cell_m, tour.most_cells);
    }
    run.waypoints = make_tour(scene.world, tour);
  } catch (const std::invalid_argument& bad) {
    t.fail(t.has("start") ? "start" : "kind", bad.what());
  } catch (const std::length_error& large) {
    t.fail("kind", large.what());
  }
}

}  // namespace

void read_route(Table& t, TrajectorySpec& run) {
  std::vector<Table> legs = t.tables("velocity", kMostLegs);
  if (t.has("waypoints") || legs.empty()) run.waypoints = t.points("waypoints", 1, 100'000);
  if (!run.waypoints.empty() && !legs.empty()) t.fail("velocity", "cannot be given beside waypoints");
  for (Table& leg : legs) {
    run.legs.push_back({leg.number("duration_s", {0, kLongestLeg_s}), leg.number("speed_m_s", {-100, 100}),
                        leg.angle_or("turn_rate_deg_s", {-36000, 36000}, 0)});
    leg.refuse_unknown_keys();
  }
  if (t.has("start") || !legs.empty()) run.start = t.pose("start");
  run.speed_m_s = t.number_or("speed_m_s", {0, 100, true}, run.speed_m_s);
  run.turn_rate_rad_s = t.angle_or("turn_rate_deg_s", {0, 36000, true}, run.turn_rate_rad_s);
}

TrajectorySpec read_trajectory(Table t, const Scene& scene, const SceneLimits& limits) {
  TrajectorySpec run;
  const std::string kind = t.text_or("kind", "");
  if (kind == "tour") {
    for (const char* other : {"waypoints", "velocity"})
      if (t.has(other)) t.fail(other, "cannot be given beside a tour");
    plan_tour(t, scene, limits, run);
    run.speed_m_s = t.number_or("speed_m_s", {0, 100, true}, run.speed_m_s);
    run.turn_rate_rad_s = t.angle_or("turn_rate_deg_s", {0, 36000, true}, run.turn_rate_rad_s);
  } else if (kind.empty()) {
    read_route(t, run);
  } else {
    t.fail("kind", "is '" + kind + "', must be \"tour\" or left out");
  }
  run.period_s = t.number_or("period_s", {1e-3, 3600}, run.period_s);
  run.seed = static_cast<std::uint64_t>(t.integer("seed", 0, std::numeric_limits<std::int64_t>::max()));
  t.refuse_unknown_keys();
  if (longest_s(run) / run.period_s > static_cast<double>(kMostSteps))
    t.fail(kind == "tour"     ? "kind"
           : run.legs.empty() ? "waypoints"
                              : "velocity",
           "the run would have more than " + std::to_string(kMostSteps) + " steps");
  return run;
}

}  // namespace evigrid::scenes
