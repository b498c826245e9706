// SPDX-License-Identifier: Apache-2.0
// run and cast on scenes with lasers, odometry and movers, on embedded scenes by name and on bare worlds.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.hpp"
#include "text.hpp"
#include "widest_place.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;

const std::string kMixed = R"([map]
cell_m = 0.1
rule = "pcr5"
[[world.polygons]]
vertices = [[0, 0], [6, 0], [6, 4], [0, 4]]
[robot]
use = "laser180"
[robot.sensor]
model = "li2014"
aperture_deg = 15
min_range_m = 0.1
max_range_m = 4
reliability = 1
[robot.ring]
count = 4
radius_m = 0.2
[trajectory]
waypoints = [[1, 1], [5, 1], [5, 3]]
seed = 3
)";

Json report(const std::vector<std::string>& arguments) {
  const Ran ran = evigrid(arguments);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return ran.code == 0 ? Json::parse(ran.out) : Json();
}

TEST(Run, TheDefaultSceneKeepsItsMap) {
  const TempDir dir;
  for (const std::string threads : {"1", "3"}) {
    EXPECT_EQ(report({"run", "-o", dir.at("out"), "--json", "-", "--threads", threads})["map_hash"],
              "3ba3a7ee628208ab");
  }
  EXPECT_EQ(report({"run", "default", "-o", dir.at("out"), "--json", "-"})["map_hash"], "3ba3a7ee628208ab");
}

TEST(Run, EveryPapersWorldByItsName) {
  const TempDir dir;
  for (const std::string name : {"hughes1992", "li2006", "li2014", "asharif2001", "delafosse2007"}) {
    const Json r = report({"run", name, "-o", dir.at(name), "--json", "-"});
    EXPECT_GT(r["readings_used"], 1000) << name;
    EXPECT_TRUE(contains(r["input"].dump(), name));
    if (name == "asharif2001") {
      EXPECT_EQ(r["scans"], 4500);
    }
  }
  const Ran ran = evigrid({"run", "hughes1993", "-o", dir.at("no")});
  EXPECT_EQ(ran.code, 2);
  EXPECT_TRUE(contains(ran.err, "hughes1993: there is no such file; embedded scenes: default, hughes1992")) << ran.err;
}

TEST(Run, SonarsAndLasersTogether) {
  const TempDir dir;
  const std::string scene = dir.write("mixed.toml", kMixed);
  const Json r = report({"run", scene, "-o", dir.at("out"), "--json", "-"});
  EXPECT_EQ(r["sensors"].size(), 5u);
  EXPECT_EQ(r["models"], Json({"li2014", "beam"}));
  EXPECT_EQ(r["sensors"][0]["reliability"], 1.0);  // as the scene states it
  EXPECT_EQ(r["sensors"][4]["beams"], 181);
  EXPECT_FALSE(r.contains("odometry"));
  // A model is meant for the sensors that it fits.
  const Json h = report({"run", scene, "-o", dir.at("out"), "--json", "-", "--model", "hughes1992"});
  EXPECT_EQ(h["models"], Json({"hughes1992", "beam"}));
  EXPECT_EQ(report({"run", scene, "-o", dir.at("out"), "--json", "-", "--model", "beam"})["map_hash"], r["map_hash"]);
  EXPECT_NE(h["map_hash"], r["map_hash"]);
  EXPECT_EQ(report({"run", scene, "-o", dir.at("out"), "--json", "-", "--threads", "3"})["map_hash"], r["map_hash"]);
}

TEST(Run, OdometryIsMappedWithAndItsErrorIsReported) {
  const TempDir dir;
  const std::string scene = dir.write("drift.toml", kMixed + "[robot.odometry]\ndrift_left = 0.02\n");
  const Json r = report({"run", scene, "-o", dir.at("out"), "--json", "-"});
  // 4 m straight with a track of 0.35 m: the left wheel runs ahead by 8 cm, which turns the robot by 0.08/0.35 rad to
  // the right; the quarter turn to the left costs it another 2 % of half the track's arc, 2 m more the rest.
  const double turned_rad = (0.02 * 4 - 0.02 * 0.175 * M_PI / 2 + 0.02 * 2) / 0.35;
  EXPECT_NEAR(r["odometry"]["final_heading_error_deg"].get<double>(), -turned_rad * 180 / M_PI, 1e-6);
  EXPECT_GT(r["odometry"]["final_position_error_m"], 0.3);
  EXPECT_GE(r["odometry"]["largest_position_error_m"], r["odometry"]["final_position_error_m"]);
  EXPECT_NEAR(r["odometry"]["way_m"].get<double>(), 6, 0.05);
  EXPECT_NE(r["map_hash"], report({"run", dir.write("a.toml", kMixed), "-o", dir.at("b"), "--json", "-"})["map_hash"]);
}

TEST(Cast, NewColumnsComeLast) {
  const TempDir dir;
  const std::string scene = dir.write("drift.toml", kMixed + "[robot.odometry]\ndrift_left = 0.02\n");
  const Ran ran = evigrid({"cast", scene, "--truth"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  std::istringstream lines(ran.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "step,stamp_ns,x_m,y_m,yaw_rad,sensor,range_m,truth,beam,odom_x_m,odom_y_m,odom_yaw_rad");
  std::size_t rows = 0, laser_rows = 0;
  double last_x = 0, last_odom_x = 0;
  while (std::getline(lines, line)) {
    double x = 0, y = 0, yaw = 0, ox = 0, oy = 0, oyaw = 0;
    int step = 0, sensor = 0, beam = 0;
    long long stamp = 0;
    char range[32] = "", truth[32] = "";
    ASSERT_EQ(std::sscanf(line.c_str(), "%d,%lld,%lf,%lf,%lf,%d,%31[^,],%31[^,],%d,%lf,%lf,%lf", &step, &stamp, &x, &y,
                          &yaw, &sensor, range, truth, &beam, &ox, &oy, &oyaw),
              12)
        << line;
    ++rows;
    laser_rows += sensor == 4;
    if (sensor < 4) {
      EXPECT_EQ(beam, 0);
    }
    last_x = x;
    last_odom_x = ox;
  }
  EXPECT_EQ(rows % 185, 0u);
  EXPECT_EQ(laser_rows, rows / 185 * 181);
  EXPECT_EQ(last_x, 5);
  EXPECT_NE(last_odom_x, 5);
  EXPECT_EQ(evigrid({"cast", scene, "--truth", "--threads", "1"}).out, ran.out);
  EXPECT_TRUE(starts_with(evigrid({"cast", "li2006"}).out, "step,stamp_ns,x_m,y_m,yaw_rad,sensor,range_m\n"));
}

TEST(Run, AnotherRobotInTheSameScene) {
  const TempDir dir;
  const Json r = report({"run", "--robot", "laser360", "-o", dir.at("out"), "--json", "-"});
  EXPECT_EQ(r["sensors"].size(), 1u);
  EXPECT_EQ(r["models"], Json({"beam"}));
  const Json seeded = report({"run", "-o", dir.at("out"), "--json", "-", "--seed", "2"});
  EXPECT_EQ(seeded["seed"], 2);
  EXPECT_NE(seeded["map_hash"], "3ba3a7ee628208ab");
}

TEST(RunWorld, APlanWithoutAScene) {
  const TempDir dir;
  std::string plan = "P2\n60 40\n255\n";  // 6 × 4 m, a wall around, one inside with a gap
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      const bool wall = x == 0 || y == 0 || x == 59 || y == 39 || (x == 30 && y < 25);
      plan += wall ? "0 " : "255 ";
    }
  const std::string file = dir.write("plan.pgm", plan);
  const Json r = report({"run", "--world", file, "--resolution", "0.1", "-o", dir.at("out"), "--json", "-"});
  EXPECT_EQ(r["cell_m"], 0.05);
  EXPECT_GE(r["size_cells"][0], 116);
  EXPECT_LE(r["size_cells"][0], 130);
  const Json s = report({"run", "--world", file, "--resolution", "0.1", "--robot", "pioneer16", "--start", "1,1,90",
                         "-o", dir.at("out"), "--json", "-"});
  EXPECT_EQ(s["cell_m"], 0.1);
  EXPECT_EQ(s["sensors"].size(), 16u);
  const auto failure = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"run", "-o", dir.at("bad")});
    const Ran ran = evigrid(more);
    EXPECT_EQ(ran.code, 2);
    EXPECT_FALSE(dir.names().contains("bad")) << ran.err;
    return ran.err;
  };
  EXPECT_TRUE(contains(failure({"--world", file, "--resolution", "0.1", "--start", "1"}), "--start: '1' is not x,y"));
  EXPECT_TRUE(contains(failure({"--world", file, "--resolution", "0.1", "--start", "0.05,1"}), "--start: "));
  EXPECT_TRUE(contains(failure({"--world", file, "--resolution", "-1"}), "--resolution: -1 is not within"));
  EXPECT_TRUE(contains(failure({"--world", dir.at("none.pgm"), "--resolution", "1"}), "none.pgm"));
  EXPECT_TRUE(contains(failure({"--world", file, "--resolution", "0.1", "--robot", "hal"}), "there is no robot 'hal'"));
  EXPECT_TRUE(contains(failure({"default", "--world", file}), "--world: cannot be given beside a scene"));
  EXPECT_TRUE(contains(failure({"--start", "1,1"}), "--start: is for --world"));
  EXPECT_TRUE(contains(failure({"--seed", "-1"}), "--seed: -1 is below 0"));
}

/// Free space with one closed room: walls one pixel thick, from (x0, y0) to (x1, y1).
scenes::FloorPlan plan_with_room(int width, int height, int x0, int y0, int x1, int y1) {
  using scenes::PlanCell;
  scenes::FloorPlan plan;
  plan.width = width;
  plan.height = height;
  plan.resolution_m = plan.resolution_y_m = 0.5;
  plan.origin = {10, 20, M_PI / 2};
  plan.cells.assign(static_cast<std::size_t>(width * height), PlanCell::free);
  for (int x = x0; x <= x1; ++x) {
    for (int y = y0; y <= y1; ++y) {
      if (x == x0 || x == x1 || y == y0 || y == y1)
        plan.cells[static_cast<std::size_t>(y * width + x)] = PlanCell::occupied;
    }
  }
  return plan;
}

TEST(WidestPlace, InsideRatherThanOutsideAndNeverInAWall) {
  // 11 × 6 free pixels inside; the two rows in their middle are farthest from the walls.
  scenes::FloorPlan plan = plan_with_room(30, 10, 16, 1, 28, 8);
  const auto inside = widest_place(plan, 0.2);
  ASSERT_TRUE(inside);
  const double column = (inside->y_m - 20) / 0.5 - 0.5, row = (10 - inside->x_m) / 0.5 - 0.5;  // the plan is turned
  EXPECT_GE(column, 19 - 1e-9);
  EXPECT_LE(column, 25 + 1e-9);
  EXPECT_GE(row, 4 - 1e-9);
  EXPECT_LE(row, 5 + 1e-9);
  const auto outside = widest_place(plan, 1.0);  // the room is too narrow for that
  ASSERT_TRUE(outside);
  EXPECT_LT((outside->y_m - 20) / 0.5, 16);
  plan.cells.assign(plan.cells.size(), scenes::PlanCell::unknown);
  EXPECT_FALSE(widest_place(plan, 0.1));
}

TEST(Run, NamesOfRulesAndModelsAreRefusedWithTheirLine) {
  const TempDir dir;
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& message) {
    std::string text = kMixed;
    text.replace(text.find(from), from.size(), to);
    const Ran ran = evigrid({"run", dir.write("s.toml", text), "-o", dir.at("out")});
    EXPECT_EQ(ran.code, 2);
    EXPECT_TRUE(contains(ran.err, message)) << ran.err;
  };
  refused("rule = \"pcr5\"", "rule = \"foo\"", "s.toml:3: map.rule: 'foo' is unknown");
  refused("model = \"li2014\"", "model = \"beam\"", "s.toml:9: robot.sensor.model: 'beam' is unknown");
}

TEST(Run, AWayThroughAWallIsWarnedOf) {
  const TempDir dir;
  std::string text = kMixed;
  text.replace(text.find("[5, 1]"), 6, "[8, 1]");
  const Ran ran = evigrid({"run", dir.write("s.toml", text), "-o", dir.at("out"), "--json", "-"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_TRUE(contains(ran.err, "through walls")) << ran.err;
  EXPECT_EQ(Json::parse(ran.out)["warnings"].size(), 1u);
  EXPECT_EQ(report({"run", dir.write("t.toml", kMixed), "-o", dir.at("out"), "--json", "-"})["warnings"].size(), 0u);
}

TEST(Run, AStartOutsideOfTheWorldIsRefusedAtOnce) {
  const TempDir dir;
  const Ran ran = evigrid({"run", "--world", "building", "--start", "1000,1000", "-o", dir.at("out")});
  EXPECT_EQ(ran.code, 2);
  EXPECT_TRUE(contains(ran.err, "--start") && contains(ran.err, "outside")) << ran.err;
}

TEST(WidestPlace, ASpeckInsideIsNoBuilding) {
  const auto outside = widest_place(plan_with_room(60, 40, 50, 10, 56, 16), 0.2);
  ASSERT_TRUE(outside);
  EXPECT_LT((outside->y_m - 20) / 0.5, 50);
}

TEST(RunWorld, ABuildingFromASeed) {
  const TempDir dir;
  const std::vector<std::string> base{"cast", "--world", "building", "--robot", "ring8", "--seed"};
  const auto rows = [&](const char* seed) {
    std::vector<std::string> all = base;
    all.push_back(seed);
    const Ran ran = evigrid(all);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out;
  };
  const std::string one = rows("1");
  EXPECT_EQ(one, rows("1"));
  EXPECT_NE(one, rows("2"));
}

}  // namespace
}  // namespace evigrid::driver
