// SPDX-License-Identifier: Apache-2.0
// [material.NAME] critical_incidence_deg, absorption; [[world.walls]] from, to; [[world.boxes]] centre, length_m,
// width_m, yaw_deg; [[world.circles]] centre, radius_m; [[world.polygons]] vertices; each with a material, or echoing
// everywhere. Plans, meshes and generated buildings: read_world_files.cpp.
#include "read.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::size_t kMostShapes = 1'000'000;
constexpr Limits kSize_m{0, 1e5, true};

}  // namespace

raycast::Material material_of(Table& shape, const Materials& materials) {
  const std::string name = shape.text_or("material", "");
  if (name.empty()) return {};  // echoes at every incidence
  const auto found = materials.find(name);
  if (found == materials.end()) shape.fail("material", "there is no [material." + name + "]");
  return found->second;
}

Materials read_materials(Table table) {
  Materials materials;
  for (const std::string& name : table.keys()) {
    Table entry = table.table(name);
    raycast::Material& material = materials[name];
    material.critical_incidence_rad =
        entry.angle_or("critical_incidence_deg", {0, 90}, material.critical_incidence_rad);
    material.absorption = entry.number_or("absorption", {0, 0.999999}, material.absorption);
    entry.refuse_unknown_keys();
  }
  return materials;
}

raycast::World read_shapes(Table& table, const Materials& materials) {
  raycast::World world;
  for (Table& t : table.tables("walls", kMostShapes)) {
    world.walls.push_back({t.point("from"), t.point("to"), material_of(t, materials)});
    t.refuse_unknown_keys();
  }
  for (Table& t : table.tables("boxes", kMostShapes)) {
    world.boxes.push_back({t.point("centre"), t.number("length_m", kSize_m), t.number("width_m", kSize_m),
                           t.angle_or("yaw_deg", {-360, 360}, 0), material_of(t, materials)});
    t.refuse_unknown_keys();
  }
  for (Table& t : table.tables("circles", kMostShapes)) {
    world.circles.push_back({t.point("centre"), t.number("radius_m", kSize_m), material_of(t, materials)});
    t.refuse_unknown_keys();
  }
  for (Table& t : table.tables("polygons", kMostShapes)) {
    world.polygons.push_back({t.points("vertices", 2, kMostShapes), material_of(t, materials)});
    t.refuse_unknown_keys();
  }
  return world;
}

raycast::World read_world(Table& root, const std::filesystem::path& base, const SceneLimits& limits) {
  const Materials materials = read_materials(root.table_or_empty("material"));
  Table table = root.table("world");
  raycast::World world = read_shapes(table, materials);
  read_world_files(table, materials, base, limits, world);
  table.refuse_unknown_keys();
  return world;
}

}  // namespace evigrid::scenes
