// SPDX-License-Identifier: Apache-2.0
#include "paper/paper_world.hpp"

#include <numbers>

#include "evigrid/scenes/simulate.hpp"
#include "world_input.hpp"

namespace evigrid::driver {

PaperWorld::PaperWorld(scenes::Scene s)
    : scene(std::move(s)),
      floor(std::make_unique<scenes::Floor>(scene.world)),
      caster(std::make_unique<raycast::Scene>(scenes::make_caster(scene))) {}

scenes::Scene paper_scene(const PaperOptions& o, const char* name, const char* robot) {
  WorldOptions own;
  own.scene = name;
  scenes::Scene scene = open_input(own).scene;
  if (!o.world.empty()) {
    WorldOptions plan;
    plan.world = o.world;
    plan.robot = robot;
    plan.start = o.start;
    plan.resolution_m = o.resolution_m;
    scenes::Scene other = open_input(plan).scene;
    other.map = scene.map;
    other.trajectory.seed = scene.trajectory.seed;
    scene = std::move(other);
  }
  if (o.seed != 0) scene.trajectory.seed = o.seed;
  return scene;
}

void cover_all(raycast::World& world, double critical_incidence_deg) {
  const raycast::Material material{critical_incidence_deg * std::numbers::pi / 180, 0};
  for (raycast::Wall& w : world.walls) w.material = material;
  for (raycast::Polygon& p : world.polygons) p.material = material;
  for (raycast::Box& b : world.boxes) b.material = material;
  for (raycast::Circle& c : world.circles) c.material = material;
}

}  // namespace evigrid::driver
