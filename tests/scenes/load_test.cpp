// SPDX-License-Identifier: Apache-2.0
// A good scene is read as written; every kind of bad one is refused with file, line, field and reason.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "evigrid/scenes/scene.hpp"

namespace evigrid::scenes {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

const std::string kGood = R"(name = "test"
[map]
cell_m = 0.1
rule = "pcr5"
[material.glass]
critical_incidence_deg = 20
[[world.walls]]
from = [0, 0]
to = [4, 0.5]
material = "glass"
[[world.boxes]]
centre = [1, 2]
length_m = 0.5
width_m = 0.25
yaw_deg = 30
[[world.circles]]
centre = [3, 3]
radius_m = 0.05
[[world.polygons]]
vertices = [[0, 0], [1, 0], [0, 1]]
[robot.sensor]
model = "li2014"
aperture_deg = 15
min_range_m = 0.1
max_range_m = 5
reliability = 0.9
noise_sigma_m = 0.01
noise_ratio = 0.005
[robot.ring]
count = 4
radius_m = 0.2
first_bearing_deg = 45
[[robot.sonar]]
x_m = 0.1
y_m = -0.1
yaw_deg = -90
max_range_m = 3
model = "hughes1992"
[trajectory]
waypoints = [[1, 1], [2, 1]]
speed_m_s = 0.4
turn_rate_deg_s = 90
period_s = 0.2
seed = 7
)";

/// kGood with one text replaced by another.
std::string with(const std::string& from, const std::string& to) {
  std::string text = kGood;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string complaint(const std::string& text) {
  try {
    (void)parse_scene(text, "room.toml");
  } catch (const SceneError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Load, GoodScene) {
  const Scene s = parse_scene(kGood, "room.toml");
  EXPECT_EQ(s.name, "test");
  EXPECT_EQ(s.map.cell_m, 0.1);
  EXPECT_EQ(s.map.rule, "pcr5");
  ASSERT_EQ(s.world.walls.size(), 1u);
  EXPECT_EQ(s.world.walls[0].to.y_m, 0.5);
  EXPECT_NEAR(s.world.walls[0].material.critical_incidence_rad, 20 * kDegree, 1e-15);
  ASSERT_EQ(s.world.boxes.size(), 1u);
  EXPECT_EQ(s.world.boxes[0].width_m, 0.25);
  EXPECT_NEAR(s.world.boxes[0].yaw_rad, 30 * kDegree, 1e-15);
  EXPECT_EQ(s.world.boxes[0].material.critical_incidence_rad, 90 * kDegree);  // no material: echoes everywhere
  ASSERT_EQ(s.world.circles.size(), 1u);
  EXPECT_EQ(s.world.circles[0].radius_m, 0.05);
  ASSERT_EQ(s.world.polygons.size(), 1u);
  EXPECT_EQ(s.world.polygons[0].vertices.size(), 3u);
  ASSERT_EQ(s.sonars.size(), 5u);
  const SonarSpec& first = s.sonars[0];
  EXPECT_NEAR(first.T_robot_sensor.x_m, 0.2 * std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(first.T_robot_sensor.yaw_rad, 45 * kDegree, 1e-15);
  EXPECT_NEAR(s.sonars[1].T_robot_sensor.yaw_rad, 135 * kDegree, 1e-15);
  EXPECT_EQ(first.model, "li2014");
  EXPECT_NEAR(first.aperture_rad, 15 * kDegree, 1e-15);
  EXPECT_EQ(first.min_range_m, 0.1);
  EXPECT_EQ(first.max_range_m, 5);
  EXPECT_EQ(first.reliability, 0.9);
  EXPECT_EQ(first.noise.sigma_m, 0.01);
  EXPECT_EQ(first.noise.ratio, 0.005);
  const SonarSpec& last = s.sonars[4];
  EXPECT_EQ(last.model, "hughes1992");
  EXPECT_EQ(last.max_range_m, 3);
  EXPECT_EQ(last.reliability, 0.9);  // from [robot.sensor]
  EXPECT_EQ(last.T_robot_sensor.y_m, -0.1);
  EXPECT_EQ(s.trajectory.waypoints.size(), 2u);
  EXPECT_EQ(s.trajectory.speed_m_s, 0.4);
  EXPECT_NEAR(s.trajectory.turn_rate_rad_s, 90 * kDegree, 1e-15);
  EXPECT_EQ(s.trajectory.period_s, 0.2);
  EXPECT_EQ(s.trajectory.seed, 7u);
}

TEST(Load, UnknownKeysAreNamedWithTheNearestKnownOne) {
  EXPECT_EQ(complaint(with("cell_m = 0.1", "cell_m = 0.1\ncel_n = 1")),
            "room.toml:4: map.cel_n: is unknown; did you mean cell_m?");
  EXPECT_EQ(complaint(with("radius_m = 0.05", "radius_m = 0.05\nmatrial = \"glass\"")),
            "room.toml:19: world.circles[0].matrial: is unknown; did you mean material?");
  EXPECT_EQ(complaint(with("[[world.walls]]", "[[world.wals]]")),
            "room.toml:7: world.wals: is unknown; did you mean walls?");
  EXPECT_EQ(complaint(with("first_bearing_deg", "first_bearing")),
            "room.toml:32: robot.ring.first_bearing: is unknown; did you mean first_bearing_deg?");
  EXPECT_EQ(complaint(with("speed_m_s", "sped_m_s")),
            "room.toml:41: trajectory.sped_m_s: is unknown; did you mean speed_m_s?");
  EXPECT_EQ(complaint("mapp = 1\n" + kGood), "room.toml:1: mapp: is unknown; did you mean map?");
  EXPECT_EQ(complaint(with("reliability = 0.9", "realiability = 0.9")),
            "room.toml:26: robot.sensor.realiability: is unknown; did you mean reliability?");
}

TEST(Load, MissingFieldsGiveTheLineOfTheirTable) {
  EXPECT_EQ(complaint(with("cell_m = 0.1\n", "")), "room.toml:2: map.cell_m: is missing");
  EXPECT_EQ(complaint(with("rule = \"pcr5\"\n", "")), "room.toml:2: map.rule: is missing");
  EXPECT_EQ(complaint(with("to = [4, 0.5]\n", "")), "room.toml:7: world.walls[0].to: is missing");
  EXPECT_EQ(complaint(with("aperture_deg = 15\n", "")), "room.toml:21: robot.sensor.aperture_deg: is missing");
  EXPECT_EQ(complaint(with("model = \"li2014\"\n", "")), "room.toml:21: robot.sensor.model: is missing");
  EXPECT_EQ(complaint(with("waypoints = [[1, 1], [2, 1]]\n", "")), "room.toml:39: trajectory.waypoints: is missing");
  EXPECT_EQ(complaint(with("seed = 7\n", "")), "room.toml:39: trajectory.seed: is missing");
  EXPECT_EQ(complaint(kGood.substr(0, kGood.find("[trajectory]"))), "room.toml:1: trajectory: is missing");
  EXPECT_EQ(complaint("[map]\ncell_m=1\nrule='x'\n"), "room.toml:1: world: is missing");
  EXPECT_EQ(complaint(""), "room.toml:1: map: is missing");
}

TEST(Load, WrongTypes) {
  EXPECT_EQ(complaint(with("cell_m = 0.1", "cell_m = \"0.1\"")), "room.toml:3: map.cell_m: must be a number");
  EXPECT_EQ(complaint(with("rule = \"pcr5\"", "rule = 5")), "room.toml:4: map.rule: must be text");
  EXPECT_EQ(complaint(with("rule = \"pcr5\"", "rule = \"\"")), "room.toml:4: map.rule: must not be empty");
  EXPECT_EQ(complaint(with("[0, 0]", "[0]")), "room.toml:8: world.walls[0].from: must be a point [x, y]");
  EXPECT_EQ(complaint(with("[0, 0]", "[0, true]")), "room.toml:8: world.walls[0].from: must be a number");
  EXPECT_EQ(complaint(with("count = 4", "count = 4.5")), "room.toml:30: robot.ring.count: must be a whole number");
  EXPECT_EQ(complaint(with("[[1, 1], [2, 1]]", "[[1, 1], 2]")),
            "room.toml:40: trajectory.waypoints[1]: must be a point [x, y]");
  EXPECT_EQ(complaint(with("[[1, 1], [2, 1]]", "3")),
            "room.toml:40: trajectory.waypoints: must be a list of points [x, y]");
  EXPECT_EQ(complaint(with("[robot.ring]", "[robot.ring_]\n[robot]\nring = 3")).substr(0, 13), "room.toml:31:");
  EXPECT_EQ(complaint("map = 3\n"), "room.toml:1: map: must be a table");
}

TEST(Load, ValuesOutOfRange) {
  EXPECT_EQ(complaint(with("cell_m = 0.1", "cell_m = 0")),
            "room.toml:3: map.cell_m: is 0, must be within [0.001, 100]");
  EXPECT_EQ(complaint(with("cell_m = 0.1", "cell_m = -0.1")),
            "room.toml:3: map.cell_m: is -0.1, must be within [0.001, 100]");
  EXPECT_EQ(complaint(with("cell_m = 0.1", "cell_m = nan")), "room.toml:3: map.cell_m: must be finite");
  EXPECT_EQ(complaint(with("[4, 0.5]", "[inf, 0.5]")), "room.toml:9: world.walls[0].to: must be finite");
  EXPECT_EQ(complaint(with("radius_m = 0.05", "radius_m = 0")),
            "room.toml:18: world.circles[0].radius_m: is 0, must be within (0, 1e+05]");
  EXPECT_EQ(complaint(with("critical_incidence_deg = 20", "critical_incidence_deg = 91")),
            "room.toml:6: material.glass.critical_incidence_deg: is 91, must be within [0, 90]");
  EXPECT_EQ(complaint(with("material = \"glass\"", "material = \"steel\"")),
            "room.toml:10: world.walls[0].material: there is no [material.steel]");
  EXPECT_EQ(complaint(with("reliability = 0.9", "reliability = 0")),
            "room.toml:26: robot.sensor.reliability: is 0, must be within (0, 1]");
  EXPECT_EQ(complaint(with("max_range_m = 5", "max_range_m = 0.1")),
            "room.toml:25: robot.sensor.max_range_m: must be greater than min_range_m");
  EXPECT_EQ(complaint(with("count = 4", "count = 1025")),
            "room.toml:30: robot.ring.count: is 1025, must be within [1, 1024]");
  EXPECT_EQ(complaint(with("[[1, 1], [2, 1]]", "[]")),
            "room.toml:40: trajectory.waypoints: has 0 points, must have 1 to 100000");
  EXPECT_EQ(complaint(with("[[0, 0], [1, 0], [0, 1]]", "[[0, 0]]")),
            "room.toml:20: world.polygons[0].vertices: has 1 points, must have 2 to 1000000");
  EXPECT_EQ(complaint(with("speed_m_s = 0.4", "speed_m_s = 0")),
            "room.toml:41: trajectory.speed_m_s: is 0, must be within (0, 100]");
  EXPECT_EQ(complaint(with("speed_m_s = 0.4", "speed_m_s = 1e-9")),
            "room.toml:40: trajectory.waypoints: the run would have more than 1000000 steps");
  EXPECT_EQ(complaint(with("seed = 7", "seed = -1")),
            "room.toml:44: trajectory.seed: is -1, must be within [0, 9223372036854775807]");
}

TEST(Load, WholeNumbersThatNoDoubleHoldsExactly) {  // 2^53 + 1 and the largest
  EXPECT_EQ(complaint(with("period_s = 0.2", "period_s = 9007199254740993")),
            "room.toml:43: trajectory.period_s: is 9007199254740992, must be within [0.001, 3600]");
  EXPECT_EQ(complaint(with("cell_m = 0.1", "cell_m = 0.1\ndecay_s = 9007199254740993")),
            "room.toml:4: map.decay_s: is 9007199254740992, must be within [0, 1e+09]");
  EXPECT_EQ(complaint(with("[[1, 1], [2, 1]]", "[[1, 1], [-9223372036854775807, 1]]")),
            "room.toml:40: trajectory.waypoints[1]: is -9223372036854775808, must be within [-1e+07, 1e+07]");
  EXPECT_EQ(parse_scene(with("cell_m = 0.1", "cell_m = 2"), "room.toml").map.cell_m, 2);
}

TEST(Load, NoSonar) {
  std::string text = with("[robot.ring]\ncount = 4\nradius_m = 0.2\nfirst_bearing_deg = 45\n", "");
  const std::size_t at = text.find("[[robot.sonar]]");
  text.erase(at, text.find("[trajectory]") - at);
  EXPECT_EQ(complaint(text),
            "room.toml:21: robot: has no sensor: neither [robot.ring] nor [[robot.sonar]] nor [[robot.laser]]");
}

TEST(Load, BrokenToml) {
  EXPECT_EQ(complaint(with("cell_m = 0.1", "cell_m = ")).substr(0, 19), "room.toml:3: toml: ");
  EXPECT_EQ(complaint(with("cell_m = 0.1", "cell_m = 0.1\ncell_m = 0.2")).substr(0, 19), "room.toml:4: toml: ");
  EXPECT_EQ(complaint(kGood.substr(0, kGood.find("[2, 1]]"))).substr(0, 18), "room.toml:40: toml");
  std::string garbage;
  for (int i = 0; i < 4096; ++i) garbage.push_back(static_cast<char>(i * 2654435761u >> 13));
  EXPECT_EQ(complaint(garbage).substr(0, 10), "room.toml:");
}

TEST(Load, KeysOfManyPartsAreRefusedBeforeTheyExhaustTheStack) {
  const auto dotted = [](std::size_t parts) {
    std::string key = "a";
    for (std::size_t i = 1; i < parts; ++i) key += ".a";
    return key;
  };
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      (void)parse_scene(text, "s.toml");
    } catch (const SceneError& e) {
      return e.what();
    }
    return "accepted";
  };
  const std::string deep = dotted(4'000'000), refused = "s.toml:2: toml: a key has more than 64 parts";
  EXPECT_EQ(complaint("\n" + deep + " = 1\n"), refused);
  EXPECT_EQ(complaint("\n[" + deep + "]\n"), refused);
  EXPECT_EQ(complaint("\nx = { " + deep + " = 1 }\n"), refused);
  EXPECT_EQ(complaint("\nx = [\"\"\"q\"\"\"\"\", { " + deep + " = 1 }]\n"), refused);  // quotes that end a string
  EXPECT_EQ(complaint("\nx = ['\\', { " + deep + " = 1 }]\n"), refused);               // no escape in a literal string
  // What is no key may have any number of dots.
  const std::string dots(1000, '.');
  const std::string strings = "name = \"" + dots + "\\\"" + dots + "\" # " + dots + "\n";
  EXPECT_EQ(complaint(strings + kGood.substr(kGood.find('\n') + 1)), "accepted");
  EXPECT_EQ(complaint("x = '''\n" + dots + "\n'''\n"), "s.toml:1: map: is missing");
  EXPECT_EQ(complaint(dotted(64) + " = 1\n").find("toml"), 2u);  // only in the file's name: read, then refused
}

TEST(Load, LimitsForScenesOfStrangers) {
  const auto complaint = [](const std::string& world, const std::string& run,
                            const SceneLimits& limits) -> std::string {
    const std::string text = "[map]\ncell_m = 0.1\nrule = \"pcr5\"\n" + world +
                             "[robot]\nuse = \"ring8\"\n[trajectory]\n" + run + "seed = 1\n";
    try {
      (void)parse_scene(text, "s.toml", {}, limits);
    } catch (const SceneError& e) {
      return e.what();
    }
    return "accepted";
  };
  const std::string still = "waypoints = [[1, 1]]\n", tour = "kind = \"tour\"\n";
  const std::string room = "[[world.polygons]]\nvertices = [[0, 0], [6, 0], [6, 5], [0, 5]]\n";
  EXPECT_EQ(complaint(room, tour, {.most_tour_cells = 5000}), "accepted");  // 64 × 54 cells
  EXPECT_EQ(complaint(room, tour, {.most_tour_cells = 3000}).substr(0, 60),
            "s.toml:9: trajectory.kind: the world has 64 x 54 cells of 0.");
  const std::string hall = "[world.building]\nwidth_m = 40\ndepth_m = 20\nroom_m = 4\n";  // 50 rooms
  EXPECT_EQ(complaint(hall, still, {.most_pieces = 500}), "accepted");
  EXPECT_EQ(complaint(hall, still, {.most_pieces = 400}),
            "s.toml:7: world.building.room_m: the building would have more than 40 rooms");
  EXPECT_EQ(complaint(hall + "furniture_per_room = 100\n", still, {.most_pieces = 1000}),
            "s.toml:8: world.building.furniture_per_room: the building would have more than 1000 pieces of furniture");
  EXPECT_EQ(complaint("[[world.plans]]\nfile = \"no.map\"\n", still, {.files = false}),
            "s.toml:4: world.plans: this scene must not read files");
  EXPECT_EQ(complaint("[[world.meshes]]\nfile = \"no.ply\"\n", still, {.files = false}),
            "s.toml:4: world.meshes: this scene must not read files");
  EXPECT_EQ(complaint("[world]\n", still, {.files = false}), "accepted");  // an embedded robot is no file
}

TEST(Load, Files) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("evigrid_scene_test_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const fs::path file = folder / "a scene.toml";
  std::ofstream(file) << kGood;
  EXPECT_EQ(load_scene(file).name, "test");
  const auto failure = [](const fs::path& path) -> std::string {
    try {
      (void)load_scene(path);
    } catch (const SceneError& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(failure(folder / "none.toml"), (folder / "none.toml").string() + ": there is no such file");
  EXPECT_EQ(failure(folder), folder.string() + ": is a folder, not a scene file");
  std::ofstream(folder / "empty.toml").flush();
  EXPECT_EQ(failure(folder / "empty.toml"), (folder / "empty.toml").string() + ": is empty");
  fs::remove_all(folder);
}

}  // namespace
}  // namespace evigrid::scenes
