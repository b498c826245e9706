// SPDX-License-Identifier: Apache-2.0
// `evigrid paper NAME --world PLAN`: the parts a behaviour is given in a user's building, the runs there, and what is
// refused.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "paper/delafosse2007/plan_loop.hpp"
#include "paper/li2014/building.hpp"
#include "paper/li2014/path_agent.hpp"
#include "paper/plan_part.hpp"
#include "paper/plan_ways.hpp"
#include "program.hpp"
#include "temp_dir.hpp"

namespace evigrid::driver {
namespace {

using raycast::Point;

/// map_server's yaml and pgm of width × height pixels of 5 cm; wall(x, y) in pixels, y from the top.
void write_plan(const TempDir& dir, int width, int height, const std::function<bool(int, int)>& wall) {
  std::string pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), '\xfe');
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (wall(x, y)) pixels[static_cast<std::size_t>(y * width + x)] = 0;
  std::ofstream(dir.at("plan.pgm"), std::ios::binary) << "P5 " << width << " " << height << " 255\n" << pixels;
  std::ofstream(dir.at("plan.yaml")) << "image: plan.pgm\nresolution: 0.05\norigin: [-2, -1, 0]\nnegate: 0\n"
                                        "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

/// Two rooms of 4.5 m with a door of 1.2 m between them, 9.3 × 4.8 m in all, a pillar in either.
void write_two_rooms(const TempDir& dir) {
  write_plan(dir, 186, 96, [](int x, int y) {
    const bool rim = x < 3 || y < 3 || x >= 183 || y >= 93;
    const bool between = x >= 91 && x < 95 && (y < 30 || y >= 54);
    const bool pillar = (std::abs(x - 45) < 4 || std::abs(x - 150) < 4) && std::abs(y - 62) < 4;
    return rim || between || pillar;
  });
}

nlohmann::json report_of(const TempDir& dir, const char* paper) {
  return nlohmann::json::parse(slurp(dir.at(std::string(paper) + "/report.json")));
}

nlohmann::json value_of(const nlohmann::json& report, const std::string& name) {
  for (const auto& f : report["findings"])
    if (f["name"] == name) return f["value"];
  ADD_FAILURE() << name;
  return nlohmann::json();
}

TEST(PlanPart, CutsWallsAtItsSidesAndClosesThem) {
  raycast::World world;
  world.polygons.push_back({{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}});  // the window cuts its lower side alone
  world.walls.push_back({{4, 1}, {6, 3}, {0.5, 0.25}});                  // from within up and out
  world.walls.push_back({{20, 20}, {30, 20}, {}});
  world.walls.push_back({{0, -0.5}, {4, 3.5}, {}});  // slanting past a corner
  world.boxes.push_back({{5, 1}, 0.4, 0.2, 0, {}});
  world.circles.push_back({{7.2, 0}, 0.4, {}});  // reaches in, stays whole
  world.circles.push_back({{9, 0}, 0.4, {}});
  const raycast::World part = part_around(world, {{4, 0}, {6, 0}}, 1);
  ASSERT_EQ(part.circles.size(), 1u);
  ASSERT_EQ(part.polygons.size(), 1u);
  EXPECT_EQ(part.polygons[0].vertices[0].x_m, 3);
  EXPECT_DOUBLE_EQ(part.polygons[0].vertices[2].x_m, 7.6);
  EXPECT_EQ(part.polygons[0].vertices[2].y_m, 1);
  ASSERT_EQ(part.walls.size(), 1u + 1u + 3u);  // the slanting one at its lower end, two of the box only touch
  EXPECT_EQ(part.walls[0].from.x_m, 4);
  EXPECT_EQ(part.walls[0].to.x_m, 4);
  EXPECT_EQ(part.walls[0].material.absorption, 0.25);
  const auto& floor = part.walls.back();
  EXPECT_EQ(floor.from.x_m, 3);
  EXPECT_DOUBLE_EQ(floor.to.x_m, 7.6);
  EXPECT_EQ(floor.to.y_m, 0);
}

TEST(PlanWays, StretchesOfAWay) {
  const std::vector<Point> way{{0, 0}, {3, 0}, {3, 4}};
  EXPECT_EQ(length_of(way), 7);
  const auto some = stretch_of(way, 2, 5);
  ASSERT_EQ(some.size(), 3u);
  EXPECT_EQ(some[0].x_m, 2);
  EXPECT_EQ(some[1].x_m, 3);
  EXPECT_EQ(some[2].y_m, 2);
  EXPECT_EQ(stretch_of(way, 3, 3).size(), 1u);
  EXPECT_EQ(stretch_of(way, 0, 7).size(), 3u);
}

/// Two rooms of 4 × 4 m, a door of 1 m at their upper end.
scenes::Scene two_rooms() {
  scenes::Scene scene;
  scene.radius_m = 0.3;
  scene.world.polygons.push_back({{{0, 0}, {8, 0}, {8, 4}, {0, 4}}, {}});
  scene.world.walls.push_back({{4, 0}, {4, 3}, {}});
  scene.trajectory.waypoints = {{1, 1}, {1, 2}};
  return scene;
}

TEST(PlanWays, GoThroughTheDoorAndKeepTheRadius) {
  const scenes::Scene scene = two_rooms();
  PlanWays ways(scene);
  const auto way = ways.find({1, 1}, {7, 1});
  ASSERT_GT(way.size(), 3u);
  EXPECT_EQ(way.front().x_m, 1);
  EXPECT_EQ(way.back().x_m, 7);
  EXPECT_GT(length_of(way), 2 * std::hypot(3, 2.5));  // over the wall's end
  EXPECT_LT(length_of(way), 9);
  const scenes::Floor floor(scene.world);
  for (std::size_t i = 1; i < way.size(); ++i)
    EXPECT_TRUE(floor.drives(way[i - 1], way[i], scene.radius_m - 0.05)) << i;
  EXPECT_TRUE(ways.find({1, 1}, {20, 1}).empty());
  scenes::Scene narrow = scene;
  narrow.world.walls[0].to.y_m = 3.6;  // 0.4 m are left, the robot needs 0.6
  EXPECT_TRUE(PlanWays(narrow).find({1, 1}, {7, 1}).empty());
}

TEST(PlanLoop, CornersStandOutAndRoughnessDoesNot) {
  raycast::World world;
  raycast::Polygon room{{{0, 0}, {6, 0}, {6, 5}, {0, 5}}, {}};
  std::vector<Point> rough;  // teeth of 2 cm along the lower wall
  for (int i = 0; i < 60; ++i) rough.push_back({0.1 * i + (i == 0 ? 0 : 0.05), i % 2 == 0 ? 0.0 : 0.02});
  room.vertices.erase(room.vertices.begin());
  room.vertices.insert(room.vertices.begin(), rough.begin(), rough.end());
  world.polygons.push_back(room);
  const std::vector<Point> way{{3, 2}, {4, 3}};
  scenes::Scene scene;
  scene.world = world;
  scene.trajectory.waypoints = way;
  const PlanWays ways(scene);
  world.polygons.push_back({{{-0.2, -0.2}, {6.2, -0.2}, {6.2, 5.2}, {-0.2, 5.2}}, {}});  // the wall's other side
  std::swap(world.polygons[0], world.polygons[1]);
  const auto corners = standing_corners(world, ways, way, 10);
  EXPECT_EQ(corners.size(), 4u);
  EXPECT_EQ(standing_corners(world, ways, way, 2.5).size(), 2u);  // those of the right wall
}

TEST(PaperWorld, Delafosse2007ClosesALoopBetweenTwoRooms) {
  TempDir dir;
  write_two_rooms(dir);
  const auto run = [&](const char* seed) {
    const Ran ran = evigrid(
        {"paper", "delafosse2007", "--world", dir.at("plan.yaml"), "-o", dir.at("delafosse2007"), "--seed", seed});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return report_of(dir, "delafosse2007");
  };
  const auto report = run("3"), again = run("3"), other = run("4");
  EXPECT_EQ(report["findings"], again["findings"]);
  EXPECT_NE(report["findings"], other["findings"]);
  EXPECT_EQ(value_of(report, "stops with no vertical edge in sight")[0], 0);
  const auto marks = value_of(report, "beacons within 0.3 m of a true landmark");
  EXPECT_GE(marks[1].get<int>(), 10);  // four corners of either room, the door, pillars
  EXPECT_GE(10 * marks[0].get<int>(), 8 * marks[1].get<int>());
  EXPECT_LT(value_of(report, "error of the place at the end of the loop, lower than odometry's")[0].get<double>(), 0.3);
  const std::string html = slurp(dir.at("delafosse2007/report.html"));
  EXPECT_NE(html.find("This is not the paper"), std::string::npos);
  EXPECT_GT(slurp(dir.at("delafosse2007/building.png")).size(), 1000u);
}

TEST(PlanWays, TheBestStretchIsTheFirstOfTheRichest) {
  const std::vector<Point> way{{0, 0}, {20, 0}};
  EXPECT_EQ(best_stretch(way, 3, [](Point p) { return p.x_m >= 5 && p.x_m <= 8 ? 1 : 0; }), 5);
  EXPECT_EQ(best_stretch(way, 3, [](Point) { return 1; }), 0);
  EXPECT_EQ(best_stretch(way, 30, [](Point p) { return p.x_m > 5 ? 1 : 0; }), 0);
}

/// Nothing touches anything, whatever the robot and the person do.
void expect_clear(const PaperWorld& building, const Patrol& patrol) {
  const double radius_m = building.scene.radius_m;
  const auto from_way = [&](Point p) {
    double least = INFINITY;
    for (std::size_t i = 1; i < patrol.stretch.size(); ++i)
      least = std::min(least, distance_to_line(p, patrol.stretch[i - 1], patrol.stretch[i]));
    return least;
  };
  for (const raycast::Box& b : patrol.things) {
    EXPECT_GE(from_way(b.centre), radius_m + std::hypot(b.length_m, b.width_m) / 2);
    EXPECT_TRUE(building.floor->stands(b.centre, std::hypot(b.length_m, b.width_m) / 2));
    EXPECT_GE(distance_to_line(b.centre, patrol.walk[0], patrol.walk[1]), 0.5);
  }
  for (const Point p : patrol.walk) EXPECT_GE(from_way(p), radius_m + 0.2);
  EXPECT_TRUE(building.floor->drives(patrol.walk[0], patrol.walk[1], 0.3));
}

TEST(Li2014Building, ThingsStandClearOfEveryLegOfTheWay) {
  scenes::Scene scene;
  scene.radius_m = 0.28;
  scene.world.polygons.push_back({{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {}});
  for (const double apart : {0.8, 1.0, 1.2, 1.5}) {  // a hairpin: beside one leg is on the other
    scene.trajectory.waypoints = {{3, 3}, {4.6, 3}, {4.6, 3 + apart}, {3, 3 + apart}};
    const PaperWorld building(scene);
    const auto patrol = find_patrol(building);
    ASSERT_TRUE(patrol) << apart;
    EXPECT_EQ(patrol->things.size(), 2u) << apart;
    expect_clear(building, *patrol);
  }
}

TEST(Li2014Building, PersonAndThingsStandClearOfWayAndWalls) {
  TempDir dir;
  write_two_rooms(dir);
  PaperOptions options;
  options.world = dir.at("plan.yaml");
  const PaperWorld building(building_scene(options, "li2014", kBuildingCell_m));
  EXPECT_EQ(building.scene.sonars.size(), 16u);
  EXPECT_EQ(building.scene.sonars[0].max_range_m, 3);  // the paper's, not the robot's own 5 m
  const auto patrol = find_patrol(building);
  ASSERT_TRUE(patrol);
  ASSERT_EQ(patrol->things.size(), 2u);
  expect_clear(building, *patrol);
  const scenes::Scene scene = patrol_scene(building.scene, *patrol);
  EXPECT_EQ(scene.movers.size(), 1u);
  EXPECT_NEAR(length_of(scene.trajectory.waypoints), 4.5 * length_of(patrol->stretch), 1e-9);

  PlanWays ways(building.scene);
  const auto errands = find_errands(building.scene, ways, {3, 6, 6, 100});
  ASSERT_EQ(errands.size(), 3u);  // nothing is farther than the second within the same length
  EXPECT_LE(length_of(errands[0].shortest), 3);
  EXPECT_LE(length_of(errands[1].shortest), 6);
  EXPECT_GT(length_of(errands[2].shortest), 6);
  const auto crossing = crossing_robot(building, errands[2]);
  ASSERT_TRUE(crossing);
  EXPECT_TRUE(building.floor->drives(crossing->trajectory.waypoints[0], crossing->trajectory.waypoints[1], 0.22));
}

TEST(PaperWorld, Li2014DrivesToAGoalAndSaysWhatItLeavesOut) {
  TempDir dir;
  write_two_rooms(dir);
  const auto run = [&](const char* threads) {
    const Ran ran = evigrid(
        {"paper", "li2014", "--quick", "--world", dir.at("plan.yaml"), "-o", dir.at("li2014"), "--threads", threads});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return report_of(dir, "li2014");
  };
  const auto report = run("1"), again = run("2");
  for (const auto& f : report["findings"]) {
    EXPECT_NE(f["aim"], "target") << f["name"];
    if (f.contains("timed")) continue;
    EXPECT_EQ(f["value"], value_of(again, f["name"])) << f["name"];
  }
  EXPECT_EQ(value_of(report, "goals that the planner reaches"), nlohmann::json({1, 1}));
  EXPECT_LT(value_of(report, "the way driven, as a multiple of the shortest one").get<double>(), 1.5);
  EXPECT_GT(value_of(report, "A: DSmT shows it").get<double>(), 0.5);
  EXPECT_GT(value_of(report, "the person where it stands: DSmT shows it").get<double>(), 0.5);
  EXPECT_GT(value_of(report, "the building: recall")[0].get<double>(), 0.3);
  ASSERT_FALSE(report["details"]["left_out"].empty());
  EXPECT_EQ(report["details"]["left_out"][0]["what"], "the U-trap");
  const std::string html = slurp(dir.at("li2014/report.html"));
  EXPECT_NE(html.find("Left out here"), std::string::npos);
  EXPECT_NE(html.find("This is not the paper"), std::string::npos);
  for (const char* picture : {"places.png", "building_dsmt.png", "dsmt_end.png", "goal1.png", "slips_corrected.png"})
    EXPECT_GT(slurp(dir.at(std::string("li2014/") + picture)).size(), 1000u) << picture;
}

TEST(PaperWorld, Li2014LeavesThePersonOutWhereThereIsNoRoom) {
  TempDir dir;  // a corridor 1.1 m wide and 8 m long
  write_plan(dir, 166, 28, [](int x, int y) { return x < 3 || y < 3 || x >= 163 || y >= 25; });
  const Ran ran = evigrid({"paper", "li2014", "--quick", "--world", dir.at("plan.yaml"), "-o", dir.at("li2014")});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto report = report_of(dir, "li2014");
  EXPECT_EQ(report["details"]["left_out"].back()["what"], "the walking person, A and B");
  for (const auto& f : report["findings"]) EXPECT_EQ(f["name"].get<std::string>().find("A: DSmT"), std::string::npos);
}

/// Every paper refuses it with exit status 2 and says why.
void refused(const TempDir& dir, const std::string& plan, const std::string& why,
             const std::vector<const char*>& names = {"delafosse2007", "li2014"}) {
  for (const char* name : names) {
    const Ran ran = evigrid({"paper", name, "--quick", "--world", dir.at(plan), "-o", dir.at("out")});
    EXPECT_EQ(ran.code, 2) << name;
    EXPECT_NE(ran.err.find(why), std::string::npos) << name << ": " << ran.err;
    EXPECT_TRUE(slurp(dir.at("out/report.json")).empty()) << name;
  }
}

TEST(PaperWorld, RefusesWhatNoRobotCanUse) {
  TempDir dir;
  refused(dir, "missing.yaml", "missing.yaml: there is no such file");
  write_plan(dir, 60, 60, [](int, int) { return true; });
  refused(dir, "plan.yaml", "plan.yaml: no pixel of the plan is free");
  write_plan(dir, 8, 8, [](int x, int y) { return x < 2 || y < 2 || x > 5 || y > 5; });  // 0.2 m wide
  refused(dir, "plan.yaml", "from a surface");
  write_plan(dir, 28, 28, [](int x, int y) { return x < 2 || y < 2 || x > 25 || y > 25; });  // 1.2 m: it only turns
  refused(dir, "plan.yaml", "plan.yaml: the robot has nowhere to go");
}

TEST(PaperWorld, Delafosse2007RefusesARoundHall) {
  TempDir dir;
  write_plan(dir, 200, 200, [](int x, int y) { return std::hypot(x - 99.5, y - 99.5) > 92; });
  refused(dir, "plan.yaml", "too open, or nothing in it has corners", {"delafosse2007"});
}

}  // namespace
}  // namespace evigrid::driver
