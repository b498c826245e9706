// SPDX-License-Identifier: Apache-2.0
// The embedded scene: it is the file of the source tree, can be driven without touching anything, and its sonars hear
// something worth mapping.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "evigrid/raycast/scene.hpp"
#include "evigrid/scenes/simulate.hpp"

namespace evigrid::scenes {
namespace {

Scene room() { return parse_scene(default_scene_text(), "default"); }

TEST(DefaultScene, IsTheFileOfTheSourceTree) {
  std::ifstream in(std::string(EVIGRID_SOURCE_DIR) + "/scenes/default/room.toml", std::ios::binary);
  const std::string file(std::istreambuf_iterator<char>(in), {});
  EXPECT_FALSE(file.empty());
  EXPECT_EQ(default_scene_text(), file);
}

TEST(DefaultScene, HasTheRingAndTheRoom) {
  const Scene s = room();
  EXPECT_EQ(s.map.rule, "dempster");
  EXPECT_EQ(s.map.cell_m, 0.05);
  ASSERT_EQ(s.sonars.size(), 24u);
  for (const SonarSpec& sonar : s.sonars) {
    EXPECT_EQ(sonar.model, "li2014");
    EXPECT_NEAR(std::hypot(sonar.T_robot_sensor.x_m, sonar.T_robot_sensor.y_m), 0.2, 1e-12);
  }
  const std::size_t steps = drive(s.trajectory).size();
  EXPECT_GT(steps, 400u);
  EXPECT_LT(steps, 1000u);
  const auto& way = s.trajectory.waypoints;  // a loop
  EXPECT_EQ(way.front().x_m, way.back().x_m);
  EXPECT_EQ(way.front().y_m, way.back().y_m);
}

TEST(DefaultScene, PathTouchesNothing) {
  const Scene s = room();
  // Everything echoes here: the distance in all directions is wanted, not what a sonar hears.
  raycast::World solid = s.world;
  for (auto& w : solid.walls) w.material = {};
  for (auto& b : solid.boxes) b.material = {};
  for (auto& c : solid.circles) c.material = {};
  for (auto& p : solid.polygons) p.material = {};
  const raycast::Scene caster(solid);
  double nearest_m = INFINITY;
  for (const Pose& pose : drive(s.trajectory)) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double yaw = quarter * std::numbers::pi / 2;
      nearest_m = std::min(nearest_m, caster.cast_cone({pose.x_m, pose.y_m, yaw, 1.6, 0, 20}).range_m);
    }
    // Inside the room, not through a wall: something in every direction.
    for (int k = 0; k < 36; ++k)
      ASSERT_LT(caster.ray_range(pose.x_m, pose.y_m, k * std::numbers::pi / 18, 20), 15) << pose.x_m << " " << pose.y_m;
  }
  EXPECT_GT(nearest_m, 0.2 + 0.12 + 0.05);  // robot, blind zone of the sonars, margin
}

TEST(DefaultScene, SonarsHearSomething) {
  const Scene s = room();
  const raycast::Scene caster(s.world);
  std::size_t heard = 0, silent = 0, too_close = 0;
  for (const Step& step : simulate(s, caster))
    for (float range_m : step.ranges_m) {
      heard += std::isfinite(range_m);
      silent += range_m == INFINITY;
      too_close += range_m == -INFINITY;
    }
  EXPECT_GT(heard, 5000u);
  EXPECT_GT(silent, 500u);  // smooth walls met askew
  EXPECT_EQ(too_close, 0u);
  RecordProperty("heard", static_cast<int>(heard));
  RecordProperty("silent", static_cast<int>(silent));
}

}  // namespace
}  // namespace evigrid::scenes
