// SPDX-License-Identifier: Apache-2.0
#include "paper/move_to_station.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "error.hpp"
#include "options.hpp"
#include "paper/points.hpp"

namespace evigrid::driver {
namespace {

constexpr double kDone_m = 0.13, kStep_m = 0.5;            // section 4
constexpr float kSurelyEmpty = 0.8f, kLittleConflict = 1;  // the two tests of section 4

struct Station {
  raycast::Point centre{};
  std::size_t cells = 0;  ///< that pass both tests
};

/// Equation (4) over the cells of both tests.
std::optional<Station> centroid(const Map& map) {
  const CellRect rect = map.bounds();
  const auto n = static_cast<std::size_t>(rect.width * rect.height);
  std::vector<float> empty(n), con(n);
  map.render(Layer::empty, rect, empty, rect.width);
  map.render(Layer::con, rect, con, rect.width);
  double x = 0, y = 0, sum = 0;
  Station out;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(empty[i] > kSurelyEmpty) || con[i] > kLittleConflict) continue;
    const double m = empty[i];
    const auto w = static_cast<std::size_t>(rect.width);
    x += m * (static_cast<double>(rect.x) + static_cast<double>(i % w) + 0.5);
    y += m * (static_cast<double>(rect.y) + static_cast<double>(i / w) + 0.5);
    sum += m;
    ++out.cells;
  }
  if (out.cells == 0) return std::nullopt;
  const double cell_m = map.params().cell_m;
  out.centre = {x / sum * cell_m, y / sum * cell_m};
  return out;
}

void move_towards(scenes::LiveRobot& robot, raycast::Point aim) {
  const scenes::Pose at = robot.believed();
  const double heading = std::atan2(aim.y_m - at.y_m, aim.x_m - at.x_m);
  robot.move(std::remainder(heading - at.yaw_rad, 2 * std::numbers::pi), std::min(kStep_m, distance(place(at), aim)));
}

}  // namespace

StationRun move_to_station(const PaperWorld& w, const scenes::Pose& start, std::uint64_t seed, const StationOptions& o,
                           const std::function<void(const Map&, const StationRun&)>& after) {
  scenes::Scene scene = w.scene;
  scene.trajectory.seed = seed;
  scenes::LiveRobot robot(*w.floor, *w.caster, scene, start);
  MapParams params;
  params.cell_m = scene.map.cell_m;
  params.rule = Rule::dempster;
  params.keep_con = true;
  RobotMap mapped(scene, params, parse_executor("tbb", o.threads), o.no_echo);
  StationRun run;
  for (int move = 0;; ++move) {
    mapped.fuse(robot.sense(), robot.believed(), move);
    run.poses.push_back(robot.pose());
    const auto station = centroid(mapped.map);
    if (station) {
      run.aims.push_back(station->centre);
      run.least_cells = std::min(run.least_cells, station->cells);
    }
    if (after) after(mapped.map, run);
    run.settled = station && distance(place(robot.believed()), station->centre) <= kDone_m;
    if (!station || run.settled || move == o.most_moves) return run;
    move_towards(robot, station->centre);
  }
}

/// Section 5.2: the vector sum of readings, each averaged over three consecutive ones; no echo counts as the full
/// range.
StationRun average_to_station(const PaperWorld& w, const scenes::Pose& start, std::uint64_t seed) {
  constexpr int kReadings = 3;
  scenes::Scene scene = w.scene;
  scene.trajectory.seed = seed;
  scenes::LiveRobot robot(*w.floor, *w.caster, scene, start);
  StationRun run;
  for (int move = 0;; ++move) {
    raycast::Point sum{};
    for (int n = 0; n < kReadings; ++n) {
      const scenes::Sensed s = robot.sense();
      for (std::size_t i = 0; i < s.ranges_m.size(); ++i) {
        const scenes::SonarSpec& sonar = scene.sonars[i];
        const double r = std::clamp<double>(s.ranges_m[i], sonar.min_range_m, sonar.max_range_m);
        const double bearing = robot.believed().yaw_rad + sonar.T_robot_sensor.yaw_rad;
        sum.x_m += r * std::cos(bearing), sum.y_m += r * std::sin(bearing);
      }
    }
    const double share = 1.0 / (kReadings * static_cast<double>(scene.sonars.size()));
    const raycast::Point aim{robot.believed().x_m + share * sum.x_m, robot.believed().y_m + share * sum.y_m};
    run.poses.push_back(robot.pose());
    run.aims.push_back(aim);
    run.settled = distance(place(robot.believed()), aim) <= kDone_m;
    if (run.settled || move == kMostMoves) return run;
    move_towards(robot, aim);
  }
}

/// Starts within a circle of diameter kApart_m around `around`, where the robot has room; any heading.
std::vector<scenes::Pose> starts_around(const PaperWorld& w, raycast::Point around, std::size_t count,
                                        std::uint64_t seed) {
  std::vector<scenes::Pose> out;
  const auto unit = [&](std::uint32_t draw, std::uint64_t n) {
    return static_cast<double>(raycast::random_bits({seed, 0, 0, n}, draw) >> 11) * 0x1p-53;
  };
  for (std::uint64_t n = 0; out.size() < count && n < 100'000; ++n) {
    const double r = kApart_m / 2 * std::sqrt(unit(0, n)), angle = 2 * std::numbers::pi * unit(1, n);
    const scenes::Pose p{around.x_m + r * std::cos(angle), around.y_m + r * std::sin(angle),
                         2 * std::numbers::pi * unit(2, n)};
    if (w.floor->stands(place(p), w.scene.radius_m + 0.02)) out.push_back(p);
  }
  if (out.size() < count)
    throw InputError(fmt::format("no room for a robot around ({:.2f}, {:.2f})", around.x_m, around.y_m));
  return out;
}

/// Centre of the smallest circle around the ends, by Bădoiu & Clarkson's iteration (2003).
raycast::Point enclosing_centre(const std::vector<StationRun>& runs) {
  raycast::Point c = runs.front().end();
  for (int i = 1; i <= 20000; ++i) {
    const StationRun* far = &runs.front();
    for (const StationRun& r : runs)
      if (distance(c, r.end()) > distance(c, far->end())) far = &r;
    c.x_m += (far->end().x_m - c.x_m) / (i + 1), c.y_m += (far->end().y_m - c.y_m) / (i + 1);
  }
  return c;
}

Spread spread(const std::vector<StationRun>& runs, raycast::Point centre) {
  Spread s{centre};
  for (const StationRun& r : runs) {
    const double d = distance(centre, r.end());
    s.largest_m = std::max(s.largest_m, d);
    s.within += d <= kStation_m;
    s.settled += r.settled;
    s.most_moves = std::max(s.most_moves, r.moves());
  }
  return s;
}

}  // namespace evigrid::driver
