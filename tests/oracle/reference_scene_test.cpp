// SPDX-License-Identifier: Apache-2.0
// evigrid::Map against the slow reference on the embedded scene: the whole simulated lap, under every rule.
#include <evigrid/raycast/scene.hpp>
#include <evigrid/scenes/scene.hpp>
#include <evigrid/scenes/simulate.hpp>

#include "tests/oracle/compare_maps.hpp"

namespace {

using namespace oracle;

TEST(ReferenceScene, EmbeddedRoomUnderEveryRule) {
  const evigrid::scenes::Scene scene = evigrid::scenes::parse_scene(evigrid::scenes::default_scene_text(), "default");
  const evigrid::raycast::Scene caster(scene.world);
  const auto steps = evigrid::scenes::simulate(scene, caster);
  ASSERT_GT(steps.size(), 400U);
  for (const evigrid::Rule rule : evigrid::map_rules()) {
    Both both({.cell_m = scene.map.cell_m, .rule = rule});
    for (const auto& s : scene.sonars) {
      evigrid::Sensor sonar;
      sonar.model = *evigrid::model_from_name(s.model);
      sonar.T_robot_sensor = {s.T_robot_sensor.x_m, s.T_robot_sensor.y_m, s.T_robot_sensor.yaw_rad};
      sonar.aperture_rad = s.aperture_rad;
      sonar.min_range_m = s.min_range_m;
      sonar.max_range_m = s.max_range_m;
      sonar.reliability = s.reliability;
      both.add(sonar);
    }
    for (const auto& step : steps) {
      std::vector<evigrid::Reading> readings;
      for (std::size_t i = 0; i < step.ranges_m.size(); ++i) {
        readings.push_back({static_cast<evigrid::SensorId>(i), {&step.ranges_m[i], 1}});
      }
      both.integrate({step.stamp_ns, {step.T_map_robot.x_m, step.T_map_robot.y_m, step.T_map_robot.yaw_rad}, readings});
    }
    SCOPED_TRACE(std::string(evigrid::name(rule)));
    EXPECT_GT(both.report().cells_updated, 1000000U);
    both.expect_equal_reports();
    const Difference d = both.difference();
    print("embedded room " + std::string(evigrid::name(rule)), d);
    // PCR4 shares the conflict as e : o, so that log-odds add up as under Dempster, and with them what the readings'
    // own masses are off by: li2014 in float is off by 2e-7 of log-odds a reading, and the 98 readings of that cell by
    // 9e-6 together, which is 2.25e-6 of BetP at 1/2, of the 2.7e-6 measured. docs/decisions.md has more.
    // dempster_log: 2.5e-6 at a cell of log-weights near 62 each after 87 updates: like readings round x/v and the step of
    // 2^-23 of the sums alike, 1.4e-7 of log-odds each.
    const bool adds_up = rule == evigrid::Rule::pcr4 || rule == evigrid::Rule::dempster_log;
    expect_within_bounds(d, adds_up ? 3e-6 : kMassBound);
  }
}

}  // namespace
