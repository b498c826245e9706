// SPDX-License-Identifier: Apache-2.0
// Which cells a cone holds, against exact double arithmetic on the same lattice: every ring of the embedded robots and
// scenes at every half degree of heading, and each of its sonars with an edge or the axis exactly along rows, columns,
// diagonals and other lines through cell centres, the apex on centres, corners and the middles of sides.
#include <gtest/gtest.h>

#include <cmath>
#include <evigrid/evigrid.hpp>
#include <evigrid/scenes/scene.hpp>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "tests/oracle/reference_lattice.hpp"

namespace {

using namespace oracle;
using evigrid::Model;
using evigrid::Pose2;
using evigrid::Sensor;

constexpr double kDegree = std::numbers::pi / 180, kCell = 0.05;

struct Ring {
  std::string name;
  std::vector<Sensor> sonars;
};

/// Rings that differ, under one model.
std::vector<Ring> rings(Model model) {
  std::vector<Ring> out;
  const auto add = [&](std::string_view name, const evigrid::scenes::Scene& scene) {
    Ring ring{std::string(name), {}};
    for (const auto& s : scene.sonars) {
      Sensor sensor;
      sensor.model = model;
      sensor.T_robot_sensor = {s.T_robot_sensor.x_m, s.T_robot_sensor.y_m, s.T_robot_sensor.yaw_rad};
      sensor.aperture_rad = s.aperture_rad;
      sensor.min_range_m = s.min_range_m;
      sensor.max_range_m = s.max_range_m;
      sensor.reliability = 0.9;
      ring.sonars.push_back(sensor);
    }
    if (!ring.sonars.empty()) out.push_back(std::move(ring));
  };
  for (const auto& robot : evigrid::scenes::embedded_robots()) {
    evigrid::scenes::Scene scene;
    evigrid::scenes::use_robot(scene, std::string(robot.name));
    add(robot.name, scene);
  }
  add("default", evigrid::scenes::parse_scene(evigrid::scenes::default_scene_text(), "default"));
  return out;
}

/// Calls hold(i, j) for each cell of the cone.
template <class Hold>
void each_cell(const Sensor& s, const Pose2& robot, float range_m, Hold hold) {
  const double c = std::cos(robot.yaw_rad), n = std::sin(robot.yaw_rad);
  const Pose2 &m = s.T_robot_sensor, at{robot.x_m + c * m.x_m - n * m.y_m, robot.y_m + n * m.x_m + c * m.y_m,
                                        robot.yaw_rad + m.yaw_rad};
  const Lattice lattice(reach_cells(s, kCell));
  const ApexCoordinate x = apex_coordinate(lattice, at.x_m, kCell), y = apex_coordinate(lattice, at.y_m, kCell);
  const Direction left = edge_direction(at.yaw_rad + s.aperture_rad / 2),
                  right = edge_direction(at.yaw_rad - s.aperture_rad / 2);
  const double range = lattice.round(range_m / kCell),
               nearest = std::max(lattice.round(s.min_range_m / kCell), lattice.step()),
               farthest = s.model == Model::li2014 ? lattice.round(range * (1 + 2 * s.li.epsilon_ratio))
                                                   : std::min(range + lattice.round(s.hughes.tolerance_m / kCell),
                                                              lattice.round(s.hughes.r_max_m / kCell));
  const auto reach = static_cast<std::int64_t>(farthest) + 2;
  for (std::int64_t j = -reach; j <= reach; ++j)
    for (std::int64_t i = -reach; i <= reach; ++i) {
      const double dx = static_cast<double>(i) - x.offset, dy = static_cast<double>(j) - y.offset;
      const double d_squared = dx * dx + dy * dy;
      if (d_squared > farthest * farthest || d_squared < nearest * nearest) continue;
      if (cross(dx, dy, left.x, left.y) < 0 || cross(right.x, right.y, dx, dy) < 0) continue;
      hold(evigrid::CellIndex{x.cell + i, y.cell + j});
    }
}

struct Compared {
  std::uint64_t cells = 0, wrong = 0;
};

/// One scan of some sonars into an empty map.
void compare(evigrid::Map& map, const Ring& ring, const std::vector<std::size_t>& which, const Pose2& robot,
             const std::vector<float>& ranges, Compared& out) {
  map.clear();
  std::vector<evigrid::Reading> readings;
  for (const std::size_t i : which) readings.push_back({static_cast<evigrid::SensorId>(i), {&ranges[i], 1}});
  const std::uint64_t updated = map.integrate(evigrid::Scan{0, robot, readings}).cells_updated;
  std::set<std::pair<std::int64_t, std::int64_t>> want;
  std::uint64_t updates = 0;
  for (const std::size_t i : which)
    each_cell(ring.sonars[i], robot, ranges[i], [&](evigrid::CellIndex c) {
      ++updates;
      want.emplace(c.y, c.x);
    });
  out.cells += updates;
  out.wrong += updates != updated;
  const evigrid::CellRect box = map.bounds();
  std::uint64_t held = 0;
  for (std::int64_t y = box.y; y < box.y + box.height; ++y)
    for (std::int64_t x = box.x; x < box.x + box.width; ++x) {
      const evigrid::Mass m = map.mass({x, y});
      if (m.e == 0 && m.o == 0) continue;
      ++held;
      out.wrong += want.count({y, x}) == 0;
    }
  out.wrong += held != want.size();
}

class RingCells : public testing::TestWithParam<Model> {};

TEST_P(RingCells, EveryHalfDegree) {
  for (const Ring& ring : rings(GetParam())) {
    evigrid::Map map({.cell_m = kCell}, std::shared_ptr<evigrid::Executor>(evigrid::make_serial_executor()));
    std::vector<std::size_t> all;
    for (const Sensor& s : ring.sonars) all.push_back(static_cast<std::size_t>(map.add(s)));
    Compared c;
    for (int half = 0; half < 720; ++half) {
      std::vector<float> ranges;
      for (std::size_t i = 0; i < all.size(); ++i)
        ranges.push_back(static_cast<float>(0.5 + 0.05 * static_cast<double>((7 * i + 13 * static_cast<std::size_t>(half)) % 31)));
      // Every fourth apex of the robot on a cell centre.
      const double off = half % 4 == 0 ? 0.5 : 0.0037 * half;
      compare(map, ring, all, {(3 + off) * kCell, (-5 + off) * kCell, half * 0.5 * kDegree}, ranges, c);
    }
    EXPECT_EQ(c.wrong, 0U) << ring.name;
    EXPECT_GT(c.cells, 500'000U) << ring.name;
  }
}

TEST_P(RingCells, ExactlyAligned) {
  for (const Ring& ring : rings(GetParam())) {
    evigrid::Map map({.cell_m = kCell}, std::shared_ptr<evigrid::Executor>(evigrid::make_serial_executor()));
    for (const Sensor& s : ring.sonars) map.add(s);
    std::vector<float> ranges(ring.sonars.size());
    Compared c;
    for (std::size_t i = 0; i < ring.sonars.size(); ++i)
      for (const double line : {0.0, 45 * kDegree, 90 * kDegree, 135 * kDegree, 180 * kDegree, 225 * kDegree,
                                270 * kDegree, 315 * kDegree, std::atan2(1, 2), std::atan2(-3, 4)})
        for (const double turn : {-0.5, 0.0, 0.5})  // the left edge, the axis, the right edge
          for (const auto& [x, y] : {std::pair{0.5, 0.5}, {0.0, 0.0}, {0.5, 0.0}, {0.0, 0.5}})
            for (const float cells : {12.0F, 30.5F}) {
              const Sensor& s = ring.sonars[i];
              const Pose2& m = s.T_robot_sensor;
              const double yaw = line + turn * s.aperture_rad - m.yaw_rad, co = std::cos(yaw), si = std::sin(yaw);
              const Pose2 robot{(7 + x) * kCell - (co * m.x_m - si * m.y_m),
                                (-64 + y) * kCell - (si * m.x_m + co * m.y_m), yaw};
              ranges[i] = cells * static_cast<float>(kCell);
              compare(map, ring, {i}, robot, ranges, c);
            }
    EXPECT_EQ(c.wrong, 0U) << ring.name;
    EXPECT_GT(c.cells, 50'000U) << ring.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Models, RingCells, testing::Values(Model::hughes1992, Model::li2014),
                         [](const auto& model) { return std::string(name(model.param)); });

}  // namespace
