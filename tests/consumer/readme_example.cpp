// SPDX-License-Identifier: Apache-2.0
// What a robot writes to embed evigrid; README shows the marked lines.
#include <cstdio>

// [readme]
#include <evigrid/evigrid.hpp>

int main() {
  evigrid::Map map({.cell_m = 0.05, .rule = evigrid::Rule::pcr5});

  evigrid::Sensor sonar;  // declared once, with its own mount, limits and reliability
  sonar.model = evigrid::Model::li2014;
  sonar.T_robot_sensor = {0.2, 0.0, 0.0};  // 20 cm ahead of the robot's centre
  sonar.aperture_rad = 0.35;
  sonar.max_range_m = 4.0;
  sonar.reliability = 0.9;
  const evigrid::SensorId front = map.add(sonar);

  const float range_m = 2.5f;  // one measurement …
  const evigrid::Reading reading{front, {&range_m, 1}};
  const evigrid::Report report = map.integrate({.stamp_ns = 0, .T_map_robot = {1, 2, 0}, .readings = {&reading, 1}});

  const evigrid::Mass m = map.mass(map.cell_at(3.7, 2.0));  // … and what the map now believes at x = 3.7 m, y = 2.0 m
  std::printf("cells %llu, refused %llu, empty %.3f, occupied %.3f, unknown %.3f\n",
              static_cast<unsigned long long>(report.cells_updated),
              static_cast<unsigned long long>(report.refused_total()), m.e, m.o, m.u);
}
// [/readme]
