// SPDX-License-Identifier: Apache-2.0
// Every embedded robot and scene can be read; the sensors sit where the published descriptions put them; a scene can
// use a robot and override parts of it; faults are told with the file that they are in.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <string>

#include "evigrid/scenes/simulate.hpp"

namespace evigrid::scenes {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::string scene_with(const std::string& robot) {
  return "[map]\ncell_m = 0.1\nrule = \"pcr5\"\n[world]\n[[world.walls]]\nfrom = [0, 0]\nto = [1, 0]\n" + robot +
         "[trajectory]\nwaypoints = [[0, 1]]\nseed = 1\n";
}

Scene with_robot(const std::string& robot) { return parse_scene(scene_with(robot), "s.toml"); }

std::string complaint(const std::string& robot) {
  try {
    (void)with_robot(robot);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Library, EveryRobotAndEverySceneLoads) {
  std::set<std::string_view> names;
  for (const Embedded& robot : embedded_robots()) {
    SCOPED_TRACE(robot.name);
    EXPECT_TRUE(names.insert(robot.name).second);
    const Scene s = with_robot("[robot]\nuse = \"" + std::string(robot.name) + "\"\n");
    EXPECT_GT(s.sonars.size() + s.lasers.size(), 0u);
    EXPECT_FALSE(s.odometry.used);
    Scene other;
    use_robot(other, std::string(robot.name));
    EXPECT_EQ(other.sonars.size(), s.sonars.size());
    EXPECT_EQ(other.lasers.size(), s.lasers.size());
    EXPECT_EQ(other.radius_m, s.radius_m);
  }
  EXPECT_EQ(names, (std::set<std::string_view>{"hughes24", "pioneer16", "pioneer16_3dx", "asharif8x8", "ring8",
                                               "laser180", "laser360"}));
  for (const Embedded& scene : embedded_scenes()) {
    SCOPED_TRACE(scene.name);
    const Scene s = parse_scene(scene.text, scene.name);
    EXPECT_GT(drive(s.trajectory).size(), 10u);
  }
  for (const char* name : {"default", "hughes1992", "asharif2001", "li2006", "li2014", "delafosse2007"})
    EXPECT_FALSE(find_embedded(embedded_scenes(), name).empty()) << name;
  EXPECT_TRUE(find_embedded(embedded_scenes(), "no such").empty());
}

/// Real rooms throw sound away somewhere; what a scene's notes say of its surfaces, its world has.
TEST(Library, RoomsOfRealExperimentsLoseEchoes) {
  for (const char* name : {"default", "hughes1992", "hughes1992_gymnasium", "hughes1992_tool_room", "li2014",
                           "li2014_drift", "li2014_utrap"}) {
    SCOPED_TRACE(name);
    const Scene s = parse_scene(std::string(find_embedded(embedded_scenes(), name)), name);
    ASSERT_FALSE(s.world.polygons.empty());
    for (const auto& p : s.world.polygons) EXPECT_LT(p.material.critical_incidence_rad, 1.4);
    if (std::string_view(name).starts_with("li2014")) {
      for (const auto& b : s.world.boxes) EXPECT_LT(b.material.critical_incidence_rad, 1.4);
    }
  }
}

TEST(Library, NobodyDrivesIntoAnything) {
  for (const Embedded& scene : embedded_scenes()) {
    SCOPED_TRACE(scene.name);
    Scene s = parse_scene(scene.text, scene.name);
    for (auto& p : s.world.polygons) p.material = {};
    for (auto& b : s.world.boxes) b.material = {};
    for (auto& c : s.world.circles) c.material = {};
    const raycast::Scene caster(s.world);
    double nearest_m = INFINITY;
    for (const Pose& p : drive(s.trajectory)) {
      for (int k = 0; k < 4; ++k)
        nearest_m = std::min(nearest_m, caster.cast_cone({p.x_m, p.y_m, k * std::numbers::pi / 2, 1.6, 0, 10}).range_m);
    }
    EXPECT_GT(nearest_m, s.radius_m);
  }
}

TEST(Library, Hughes24IsTheRingOfThePaper) {
  const Scene s = with_robot("[robot]\nuse = \"hughes24\"\n");
  ASSERT_EQ(s.sonars.size(), 24u);
  EXPECT_EQ(s.radius_m, 0.353);
  for (int i = 0; i < 24; ++i) {
    const SonarSpec& sonar = s.sonars[static_cast<std::size_t>(i)];
    EXPECT_NEAR(sonar.T_robot_sensor.x_m, 0.353 * std::cos(15 * i * kDegree), 1e-12);
    EXPECT_NEAR(sonar.T_robot_sensor.y_m, 0.353 * std::sin(15 * i * kDegree), 1e-12);
    EXPECT_NEAR(sonar.T_robot_sensor.yaw_rad, 15 * i * kDegree, 1e-12);
    EXPECT_NEAR(sonar.aperture_rad / 2, 15 * kDegree, 1e-12);  // β
    EXPECT_EQ(sonar.min_range_m, 0.09);
    EXPECT_EQ(sonar.max_range_m, 7.62);
    EXPECT_EQ(sonar.model, "hughes1992");
    EXPECT_EQ(sonar.reliability, 1);
  }
}

TEST(Library, PioneersAreMirrorImagesWithThePublishedBearings) {
  const double bearing_deg[16] = {90, 50, 30, 10, -10, -30, -50, -90, -90, -130, -150, -170, 170, 150, 130, 90};
  for (const char* name : {"pioneer16", "pioneer16_3dx"}) {
    SCOPED_TRACE(name);
    const Scene s = with_robot(std::string("[robot]\nuse = \"") + name + "\"\n");
    ASSERT_EQ(s.sonars.size(), 16u);
    for (std::size_t i = 0; i < 16; ++i) {
      const Pose &a = s.sonars[i].T_robot_sensor, &mirror = s.sonars[i < 8 ? 7 - i : 23 - i].T_robot_sensor;
      EXPECT_NEAR(a.yaw_rad, bearing_deg[i] * kDegree, 1e-12) << i;
      EXPECT_EQ(a.x_m, mirror.x_m) << i;
      EXPECT_EQ(a.y_m, -mirror.y_m) << i;
      EXPECT_LT(std::hypot(a.x_m, a.y_m), s.radius_m) << i;
      EXPECT_EQ(s.sonars[i].group, i < 8 ? 0 : 1);
    }
  }
  const Scene dx = with_robot("[robot]\nuse = \"pioneer16\"\n");
  EXPECT_EQ(dx.sonars[3].T_robot_sensor.x_m, 0.170);
  EXPECT_EQ(dx.sonars[3].T_robot_sensor.y_m, 0.025);
  EXPECT_NEAR(dx.sonars[0].aperture_rad, 15 * kDegree, 1e-12);
  EXPECT_EQ(with_robot("[robot]\nuse = \"pioneer16_3dx\"\n").sonars[14].T_robot_sensor.x_m, -0.203);
}

TEST(Library, RingsOfAsharifAndOfTheRecordedLog) {
  const Scene a = with_robot("[robot]\nuse = \"asharif8x8\"\n");
  ASSERT_EQ(a.sonars.size(), 8u);
  ASSERT_EQ(a.lasers.size(), 8u);
  for (int i = 0; i < 8; ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_NEAR(a.sonars[k].T_robot_sensor.yaw_rad, 45 * i * kDegree, 1e-12);
    const Pose& laser = a.lasers[k].T_robot_sensor;
    EXPECT_NEAR(std::remainder(laser.yaw_rad - (22.5 + 45 * i) * kDegree, 2 * std::numbers::pi), 0, 1e-12);
    EXPECT_NEAR(std::atan2(laser.y_m, laser.x_m), std::remainder(laser.yaw_rad, 2 * std::numbers::pi), 1e-5);
    EXPECT_EQ(a.lasers[k].beams, 1);
  }
  const Scene r = with_robot("[robot]\nuse = \"ring8\"\n");
  ASSERT_EQ(r.sonars.size(), 8u);
  EXPECT_NEAR(r.sonars[1].T_robot_sensor.yaw_rad, -37.5 * kDegree, 1e-12);
  EXPECT_EQ(with_robot("[robot]\nuse = \"laser180\"\n").lasers[0].beams, 181);
  EXPECT_NEAR(with_robot("[robot]\nuse = \"laser180\"\n").lasers[0].first_rad, -90 * kDegree, 1e-12);
  EXPECT_EQ(with_robot("[robot]\nuse = \"laser360\"\n").lasers[0].beams, 360);
}

TEST(UseRobot, TheSceneOutranksTheRobot) {
  const Scene s = with_robot(
      "[robot]\nuse = \"hughes24\"\nradius_m = 0.5\n[robot.sensor]\nmax_range_m = 3\n[robot.ring]\ncount = 4\n"
      "[[robot.laser]]\nx_m = 0.1\ny_m = 0.2\nyaw_deg = 90\nfirst_deg = -45\nstep_deg = 0.5\nbeams = 181\n"
      "min_range_m = 0.1\nmax_range_m = 9\nreliability = 0.8\nnoise_sigma_m = 0.02\nnoise_ratio = 0.01\n"
      "[robot.echo]\nsecond_bounce = true\ncross_talk = true\n[robot.odometry]\ndrift_left = 0.01\n");
  EXPECT_EQ(s.radius_m, 0.5);
  ASSERT_EQ(s.sonars.size(), 4u);
  EXPECT_EQ(s.sonars[0].max_range_m, 3);
  EXPECT_EQ(s.sonars[0].min_range_m, 0.09);                   // the robot's
  EXPECT_NEAR(s.sonars[0].T_robot_sensor.x_m, 0.353, 1e-12);  // the robot's
  ASSERT_EQ(s.lasers.size(), 1u);
  const LaserSpec& laser = s.lasers[0];
  EXPECT_EQ(laser.model, "beam");
  EXPECT_EQ(laser.T_robot_sensor.y_m, 0.2);
  EXPECT_NEAR(laser.T_robot_sensor.yaw_rad, 90 * kDegree, 1e-15);
  EXPECT_NEAR(laser.first_rad, -45 * kDegree, 1e-15);
  EXPECT_NEAR(laser.step_rad, 0.5 * kDegree, 1e-15);
  EXPECT_EQ(laser.beams, 181);
  EXPECT_EQ(laser.min_range_m, 0.1);
  EXPECT_EQ(laser.max_range_m, 9);
  EXPECT_EQ(laser.reliability, 0.8);
  EXPECT_EQ(laser.noise.sigma_m, 0.02);
  EXPECT_EQ(laser.noise.ratio, 0.01);
  EXPECT_TRUE(s.echo.second_bounce);
  EXPECT_TRUE(s.echo.cross_talk);
  EXPECT_TRUE(s.odometry.used);
  EXPECT_EQ(s.odometry.drift_left, 0.01);
  EXPECT_EQ(s.odometry.track_m, 0.5);  // the robot's
}

TEST(UseRobot, ListsAreReplaced) {
  const Scene s = with_robot("[robot]\nuse = \"pioneer16\"\n[[robot.sonar]]\nx_m = 1\ny_m = 2\nyaw_deg = 3\n");
  ASSERT_EQ(s.sonars.size(), 1u);
  EXPECT_EQ(s.sonars[0].T_robot_sensor.x_m, 1);
  EXPECT_EQ(s.sonars[0].max_range_m, 5);
}

TEST(UseRobot, AFileBesideTheScene) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("evigrid_robot_test_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const auto write = [&](const char* name, const std::string& text) { std::ofstream(folder / name) << text; };
  const auto failure = [&](const char* scene) -> std::string {
    try {
      (void)load_scene(folder / scene);
    } catch (const SceneError& e) {
      return e.what();
    }
    return "accepted";
  };
  const std::string in = folder.string() + "/";
  write("mine.toml",
        "name = \"mine\"\n[robot.sensor]\nmodel = \"li2014\"\naperture_deg = 15\nmax_range_m = 4\n"
        "[robot.ring]\ncount = 3\nradius_m = 0.2\n");
  write("a.toml", scene_with("[robot]\nuse = \"mine.toml\"\n"));
  EXPECT_EQ(load_scene(folder / "a.toml").sonars.size(), 3u);
  Scene s;
  use_robot(s, in + "mine.toml");
  EXPECT_EQ(s.sonars.size(), 3u);

  write("gone.toml", scene_with("[robot]\nuse = \"none.toml\"\n"));
  EXPECT_EQ(failure("gone.toml"), in + "gone.toml:9: robot.use: there is no such file: " + in + "none.toml");
  // A fault inside the robot's file is told with that file and its line.
  write("mine.toml",
        "[robot.sensor]\nmodel = \"li2014\"\naperture_deg = 99\nmax_range_m = 4\n[robot.ring]\ncount = 3\n"
        "radius_m = 0.2\n");
  EXPECT_EQ(failure("a.toml"), in + "mine.toml:3: robot.sensor.aperture_deg: is 99, must be within (0, 60]");
  write("mine.toml",
        "[robot.sensor]\nmodel = \"li2014\"\naperture_deg = 9\nmax_range_m = 4\n[robot.ring]\ncount = 3\n"
        "radius_n = 0.2\n");
  EXPECT_EQ(failure("a.toml"), in + "mine.toml:5: robot.ring.radius_m: is missing");
  write("mine.toml", "[robot]\nuse = \"hughes24\"\n");
  EXPECT_EQ(failure("a.toml"), in + "mine.toml:2: robot.use: a robot file cannot use another robot");
  write("mine.toml", "[robot]\nradius_m = 1\n[map]\n");
  EXPECT_EQ(failure("a.toml"), in + "mine.toml:3: map: is unknown");
  write("mine.toml", "[robot\n");
  EXPECT_EQ(failure("a.toml").substr(0, in.size() + 18), in + "mine.toml:1: toml:");
  fs::remove_all(folder);
}

TEST(UseRobot, BadFields) {
  const std::string known = "known: hughes24, pioneer16, pioneer16_3dx, asharif8x8, ring8, laser180, laser360";
  const auto laser = [](const std::string& line) {
    const std::string good[] = {"x_m = 0",      "y_m = 0",    "yaw_deg = 0",    "first_deg = 0",
                                "step_deg = 1", "beams = 10", "max_range_m = 8"};
    std::string text = "[[robot.laser]]\n";
    for (const std::string& field : good)
      if (field.substr(0, field.find(' ')) != line.substr(0, line.find(' '))) text += field + "\n";
    return text + (line.find('=') == std::string::npos ? "" : line + "\n");
  };
  EXPECT_EQ(complaint(laser("beams = 10")), "accepted");
  const std::pair<std::string, std::string> matrix[] = {
      {"[robot]\nuse = \"hughes25\"\n",
       "s.toml:9: robot.use: there is no robot 'hughes25' (a file's name ends in .toml); " + known},
      {"[robot]\nuse = 3\n", "s.toml:9: robot.use: must be text"},
      {"[robot]\nues = \"hughes24\"\n", "s.toml:9: robot.ues: is unknown; did you mean use?"},
      {"[robot]\nradius_m = 0.2\n",
       "s.toml:8: robot: has no sensor: neither [robot.ring] nor [[robot.sonar]] nor [[robot.laser]]"},
      {"[robot]\nradius_m = -1\n", "s.toml:9: robot.radius_m: is -1, must be within [0, 100]"},
      {laser("x_m"), "s.toml:8: robot.laser[0].x_m: is missing"},
      {laser("beams"), "s.toml:8: robot.laser[0].beams: is missing"},
      {laser("max_range_m"), "s.toml:8: robot.laser[0].max_range_m: is missing"},
      {laser("beams = 0"), "s.toml:15: robot.laser[0].beams: is 0, must be within [1, 100000]"},
      {laser("beams = 2.5"), "s.toml:15: robot.laser[0].beams: must be a whole number"},
      {laser("beams = 361"), "s.toml:13: robot.laser[0].step_deg: times beams is more than a full circle"},
      {laser("step_deg = 0"), "s.toml:15: robot.laser[0].step_deg: is 0, must be within (0, 360]"},
      {laser("max_range_m = 0"), "s.toml:15: robot.laser[0].max_range_m: must be greater than min_range_m"},
      {laser("aperture_deg = 3"), "s.toml:16: robot.laser[0].aperture_deg: is unknown"},
      {laser("beams = 10") + "[robot.echo]\nsecond_bounce = 1\n",
       "s.toml:17: robot.echo.second_bounce: must be true or false"},
      {laser("beams = 10") + "[robot.odometry]\ntrack_m = 0\n",
       "s.toml:17: robot.odometry.track_m: is 0, must be within [0.001, 100]"},
      {laser("beams = 10") + "[robot.odometry]\ndrift = 0\n",
       "s.toml:17: robot.odometry.drift: is unknown; did you mean drift_left?"},
      {"[robot]\nuse = \"ring8\"\n[robot.sensor]\ngroup = -1\n",
       "s.toml:11: robot.sensor.group: is -1, must be within [0, 1023]"},
  };
  for (const auto& [text, message] : matrix) EXPECT_EQ(complaint(text), message) << text;
}

}  // namespace
}  // namespace evigrid::scenes
