// SPDX-License-Identifier: Apache-2.0
#include "paper/li2014/building.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "paper/li2014/path_agent.hpp"
#include "paper/plan_part.hpp"

namespace evigrid::driver {
namespace {

using raycast::Point;

constexpr double kLeastErrand_m = 1, kStretch_m = 4, kLeastStretch_m = 2, kLook_m = 0.5, kMostLooked_m = 400;
constexpr double kHalfWalk_m = 0.6;
constexpr double kPerson_m = 0.22;  // around the middle of its two legs
constexpr double kThing_m = 0.16;   // half a diagonal of the larger one
constexpr double kGap_m = 0.1;      // between any two of robot, person, things and walls
constexpr double kSight_m = 0.02;   // how narrow a gap one sees through
constexpr std::array kBeside_m{1.1, 0.9, 1.3, 0.75};
constexpr std::size_t kSides = 16, kMostSides = 12;
constexpr double kWall_m = 2.5;
constexpr std::size_t kMostCandidates = 48;
constexpr double kLeastCrossed_m = 4, kCrossing_m = 0.22,
                 kCrossingSpeed_m_s = 0.15;  // the other robot, as the paper's scene has it

Point along(Point p, double x, double y, double by) { return {p.x_m + by * x, p.y_m + by * y}; }

double distance_to_way(Point p, const std::vector<Point>& way) {
  double least = distance(p, way.front());
  for (std::size_t i = 1; i < way.size(); ++i) least = std::min(least, distance_to_line(p, way[i - 1], way[i]));
  return least;
}

/// A point of the way, its direction there.
struct Spot {
  Point at;
  double x, y;
};
std::optional<Spot> spot_of(const std::vector<Point>& way, double s) {
  const double all = length_of(way);
  const std::vector<Point> around = stretch_of(way, std::max(0.0, s - 0.2), std::min(all, s + 0.2));
  const Point a = around.front(), b = around.back();
  const double d = distance(a, b);
  if (d < 0.05) return std::nullopt;
  return Spot{stretch_of(way, s, s).front(), (b.x_m - a.x_m) / d, (b.y_m - a.y_m) / d};
}

class Placer {
 public:
  Placer(const PaperWorld& building, std::vector<Point> stretch)
      : floor_(*building.floor), radius_m_(building.scene.radius_m), stretch_(std::move(stretch)) {}

  /// A line for the person beside the middle of the stretch.
  bool place_person(Patrol& patrol) const {
    const auto spot = spot_of(stretch_, length_of(stretch_) / 2);
    if (!spot) return false;
    for (const double off : kBeside_m) {
      for (const double side : {1.0, -1.0}) {
        const Point p = along(spot->at, -spot->y, spot->x, side * off);
        patrol.walk = {along(p, spot->x, spot->y, -kHalfWalk_m), along(p, spot->x, spot->y, kHalfWalk_m)};
        const auto clear = [&](double t) {
          return distance_to_way(along(p, spot->x, spot->y, t * kHalfWalk_m), stretch_) >=
                 radius_m_ + kPerson_m + kGap_m;
        };
        if (floor_.stands(p, kPerson_m + kGap_m) && floor_.drives(patrol.walk[0], patrol.walk[1], kPerson_m + kGap_m) &&
            floor_.drives(spot->at, p, kSight_m) && clear(-1) && clear(-0.5) && clear(0) && clear(0.5) && clear(1))
          return true;
      }
    }
    return false;
  }

  void place_things(Patrol& patrol) const {
    const double middle = length_of(stretch_) / 2;
    for (const double s : {middle - 1.4, middle + 1.4, middle - 1, middle + 1, middle - 1.8, middle + 1.8}) {
      if (patrol.things.size() == 2) return;
      if (s < 0 || s > 2 * middle) continue;
      if (const auto spot = spot_of(stretch_, s)) place_thing(*spot, patrol);
    }
  }

 private:
  void place_thing(const Spot& spot, Patrol& patrol) const {
    for (const double off : kBeside_m) {
      for (const double side : {1.0, -1.0}) {
        const Point q = along(spot.at, -spot.y, spot.x, side * off);
        const bool alone = std::all_of(patrol.things.begin(), patrol.things.end(), [&](const raycast::Box& b) {
          return distance(q, b.centre) >= 2 * kThing_m + radius_m_ + kGap_m;
        });
        if (!alone || !floor_.stands(q, kThing_m + kGap_m) || !floor_.drives(spot.at, q, kSight_m) ||
            distance_to_way(q, stretch_) < radius_m_ + kThing_m + kGap_m ||
            distance_to_line(q, patrol.walk[0], patrol.walk[1]) < kPerson_m + kThing_m + 2 * kGap_m)
          continue;
        constexpr double kDegree = std::numbers::pi / 180;
        patrol.things.push_back(patrol.things.empty() ? raycast::Box{q, 0.25, 0.2, 20 * kDegree, {}}
                                                      : raycast::Box{q, 0.2, 0.2, 40 * kDegree, {}});
        return;
      }
    }
  }

  const scenes::Floor& floor_;
  double radius_m_;
  std::vector<Point> stretch_;
};

/// In how many of kSides directions a wall is near enough to be heard well.
std::size_t walls_around(const PaperWorld& building, Point at) {
  std::size_t sides = 0;
  for (std::size_t k = 0; k < kSides; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(kSides);
    sides += building.caster->ray_range(at.x_m, at.y_m, angle, kWall_m) <= kWall_m;
  }
  return sides;
}

double reach_of(const scenes::Scene& scene) {
  double reach_m = 0;
  for (const scenes::SonarSpec& s : scene.sonars) reach_m = std::max(reach_m, s.max_range_m);
  return reach_m + 1;
}

}  // namespace

scenes::Scene building_scene(const PaperOptions& o, const char* name, double cell_m) {
  scenes::Scene scene = paper_scene({.seed = o.seed}, name, "pioneer16");
  scenes::Scene plan = paper_scene(o, name, "pioneer16");
  scene.name = plan.name;
  scene.world = std::move(plan.world);
  scene.movers.clear();
  scene.map.cell_m = cell_m;
  scene.trajectory.waypoints = std::move(plan.trajectory.waypoints);
  scene.trajectory.start = plan.trajectory.start;
  return scene;
}

std::optional<Patrol> find_patrol(const PaperWorld& building) {
  const std::vector<Point>& tour = building.scene.trajectory.waypoints;
  const double all = length_of(tour);
  std::optional<Patrol> best;
  std::size_t most = 0;
  for (double s = 0; s <= std::min(all, kMostLooked_m); s += kLook_m) {
    Patrol patrol{stretch_of(tour, std::max(0.0, s - kStretch_m / 2), std::min(all, s + kStretch_m / 2)), {}, {}};
    if (length_of(patrol.stretch) < kLeastStretch_m) continue;
    const Placer placer(building, patrol.stretch);
    if (!placer.place_person(patrol)) continue;
    placer.place_things(patrol);
    const bool enclosed = walls_around(building, stretch_of(tour, s, s).front()) >= kMostSides;
    const std::size_t worth = 1 + patrol.things.size() + (enclosed ? 3 : 0);
    if (worth > most) most = worth, best = std::move(patrol);
    if (most == 6) break;
  }
  return best;
}

scenes::Scene patrol_scene(const scenes::Scene& building, const Patrol& patrol) {
  scenes::Scene scene = building;
  scene.map.cell_m = kPlaceCell_m;
  scene.world = part_around(building.world, patrol.stretch, reach_of(building));
  scene.world.boxes = patrol.things;
  scenes::MoverSpec person;
  person.name = "person";
  person.shape.circles = {{{0.05, 0.12}, 0.08, {}}, {{-0.05, -0.12}, 0.08, {}}};  // two legs
  person.trajectory.waypoints = {patrol.walk[0], patrol.walk[1], patrol.walk[0]};
  person.trajectory.speed_m_s = 0.4, person.trajectory.turn_rate_rad_s = std::numbers::pi;
  person.loop = true;
  scene.movers = {std::move(person)};
  scene.trajectory.start.reset();
  auto& way = scene.trajectory.waypoints;
  way = patrol.stretch;
  for (int turn = 0; turn < 3; ++turn) {
    const std::vector<Point> back(patrol.stretch.rbegin(), patrol.stretch.rend());
    const std::vector<Point>& next = turn % 2 == 0 ? back : patrol.stretch;
    way.insert(way.end(), next.begin() + 1, next.end());
  }
  const std::vector<Point> half = stretch_of(patrol.stretch, 0, length_of(patrol.stretch) / 2);
  way.insert(way.end(), half.begin() + 1, half.end());
  return scene;
}

scenes::Scene stretch_scene(const PaperWorld& building, double most_m, bool from_start) {
  scenes::Scene scene = building.scene;
  auto& way = scene.trajectory.waypoints;
  const double from_m = from_start ? 0 : best_stretch(way, most_m, [&](Point p) { return walls_around(building, p); });
  if (from_m > 0) scene.trajectory.start.reset();
  way = stretch_of(way, from_m, std::min(from_m + most_m, length_of(way)));
  scene.world = part_around(scene.world, way, reach_of(scene));
  return scene;
}

std::vector<Errand> find_errands(const scenes::Scene& building, PlanWays& ways, const std::vector<double>& within_m) {
  const std::vector<Point>& tour = building.trajectory.waypoints;
  std::vector<Errand> all;
  const std::size_t step = std::max<std::size_t>(1, tour.size() / kMostCandidates);
  for (std::size_t i = 1; i < tour.size(); i += step) all.push_back({tour[i], ways.find(tour.front(), tour[i])});
  std::vector<Errand> out;
  double nearest_m = kLeastErrand_m;
  for (const double most_m : within_m) {
    const Errand* best = nullptr;
    double best_m = nearest_m;
    for (const Errand& e : all)
      if (const double m = length_of(e.shortest); m > best_m && m <= most_m) best = &e, best_m = m;
    if (best == nullptr) continue;
    out.push_back(*best);
    nearest_m = best_m;
  }
  return out;
}

std::optional<scenes::MoverSpec> crossing_robot(const PaperWorld& building, const Errand& errand) {
  const double all = length_of(errand.shortest);
  if (all < kLeastCrossed_m) return std::nullopt;
  for (const double share : {0.5, 0.4, 0.6, 0.3, 0.7}) {
    const auto spot = spot_of(errand.shortest, share * all);
    if (!spot) continue;
    for (const double half : {1.2, 1.0, 0.8, 0.6}) {
      const Point a = along(spot->at, -spot->y, spot->x, -half), b = along(spot->at, -spot->y, spot->x, half);
      if (!building.floor->stands(a, kCrossing_m) || !building.floor->drives(a, b, kCrossing_m)) continue;
      scenes::MoverSpec robot;
      robot.name = "other robot";
      robot.shape.circles = {{{0, 0}, kCrossing_m, {}}};
      robot.trajectory.waypoints = {a, b, a};
      robot.trajectory.speed_m_s = kCrossingSpeed_m_s, robot.trajectory.turn_rate_rad_s = std::numbers::pi / 2;
      robot.loop = true;
      return robot;
    }
  }
  return std::nullopt;
}

}  // namespace evigrid::driver
