// SPDX-License-Identifier: Apache-2.0
// [[world.plans]] file, resolution_m | size_m, origin, negate, occupied_threshold, free_threshold, simplify_px,
// unknown, border; [[world.meshes]] file, scale, height_m, x_m, y_m, yaw_deg, up; [world.building] width_m, depth_m,
// seed, room_m, corridor_m, door_m, wall_m, furniture_per_room; each with a material. Files are looked for from the
// scene's folder on.
#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>
#include <stdexcept>

#include "evigrid/scenes/building.hpp"
#include "evigrid/scenes/mesh.hpp"
#include "evigrid/scenes/plan.hpp"
#include "read.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::size_t kMostFiles = 64;
/// All plans and meshes of a world together.
constexpr std::size_t kMostCorners = 20'000'000;
constexpr double kPiecesPerRoom = 10;  // of the limit; a building of furniture_per_room 3 is far below
constexpr Limits kPlace_m{-1e7, 1e7};

/// What a format says itself must not be said again: one of the two would be ignored.
void refuse(Table& t, std::initializer_list<const char*> keys, const char* message) {
  for (const char* key : keys)
    if (t.has(key)) t.fail(key, message);
}

ImageScale read_scale(Table& t, const std::string& extension) {
  if (extension == ".yaml" || extension == ".yml")
    refuse(t, {"resolution_m", "size_m", "negate", "occupied_threshold", "free_threshold"},
           "is said by the yaml itself");
  if (extension == ".map")
    refuse(t, {"negate", "occupied_threshold", "free_threshold"}, "has no meaning for a MovingAI map");
  ImageScale scale;
  if (t.has("resolution_m")) scale.resolution_m = t.number("resolution_m", {1e-6, 1e3});
  if (t.has("size_m")) {
    scale.size_m = t.point("size_m");
    if (!(scale.size_m->x_m >= 1e-6 && scale.size_m->y_m >= 1e-6)) t.fail("size_m", "both sides must be positive");
    if (scale.resolution_m) t.fail("size_m", "is given together with resolution_m: one of them is enough");
  }
  if (t.has("origin")) scale.origin = t.pose("origin");
  scale.negate = t.boolean_or("negate", scale.negate);
  scale.occupied_threshold = t.number_or("occupied_threshold", {0, 1}, scale.occupied_threshold);
  scale.free_threshold = t.number_or("free_threshold", {0, 1}, scale.free_threshold);
  if (scale.free_threshold > scale.occupied_threshold) t.fail("free_threshold", "is greater than occupied_threshold");
  return scale;
}

TraceOptions read_trace_options(Table& t, const Materials& materials) {
  TraceOptions options;
  options.simplify_px = t.number_or("simplify_px", {0, 100}, options.simplify_px);
  const std::string unknown = t.text_or("unknown", "free");
  if (unknown != "free" && unknown != "wall") t.fail("unknown", "is " + unknown + ", must be free or wall");
  options.unknown_is_wall = unknown == "wall";
  options.border_is_wall = t.boolean_or("border", options.border_is_wall);
  options.material = material_of(t, materials);
  return options;
}

/// All keys are asked for, and unknown ones refused, before the file is opened.
void read_plan(Table& t, const Materials& materials, const std::filesystem::path& base, raycast::World& world) {
  const std::filesystem::path file = base / t.text("file");
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const ImageScale scale = read_scale(t, extension);
  const TraceOptions options = read_trace_options(t, materials);
  t.refuse_unknown_keys();
  try {
    for (raycast::Polygon& polygon : trace(load_plan(file, scale), options))
      world.polygons.push_back(std::move(polygon));
  } catch (const SceneError& e) {
    t.fail("file", e.what());
  } catch (const std::length_error& e) {
    t.fail("file", file.string() + ": " + e.what());
  }
}

void read_mesh(Table& t, const Materials& materials, const std::filesystem::path& base, raycast::World& world) {
  const std::filesystem::path file = base / t.text("file");
  MeshPlacement placement;
  placement.scale = t.number_or("scale", {0, 1e6, true}, placement.scale);
  placement.height_m = t.number_or("height_m", {-1e6, 1e6}, placement.height_m);
  placement.T_map_mesh = {t.number_or("x_m", kPlace_m, 0), t.number_or("y_m", kPlace_m, 0),
                          t.angle_or("yaw_deg", {-360, 360}, 0)};
  const std::string up = t.text_or("up", "z");
  if (up != "z" && up != "y") t.fail("up", "is " + up + ", must be z or y");
  placement.y_up = up == "y";
  placement.material = material_of(t, materials);
  t.refuse_unknown_keys();
  try {
    const std::vector<raycast::Wall> walls = slice(load_mesh(file), placement);
    if (walls.empty()) t.fail("height_m", "the plane of the sensors meets no part of " + file.string());
    world.walls.insert(world.walls.end(), walls.begin(), walls.end());
  } catch (const std::invalid_argument& e) {
    t.fail("file", file.string() + ": " + e.what());
  }
}

void read_building(Table t, const Materials& materials, const SceneLimits& limits, raycast::World& world) {
  BuildingSpec spec;
  spec.width_m = t.number_or("width_m", {1, 1e4}, spec.width_m);
  spec.depth_m = t.number_or("depth_m", {1, 1e4}, spec.depth_m);
  if (t.has("seed"))
    spec.seed = static_cast<std::uint64_t>(t.integer("seed", 0, std::numeric_limits<std::int64_t>::max()));
  spec.room_m = t.number_or("room_m", {0.5, 1e3}, spec.room_m);
  spec.corridor_m = t.number_or("corridor_m", {0.1, 100}, spec.corridor_m);
  spec.door_m = t.number_or("door_m", {0.1, 100}, spec.door_m);
  spec.wall_m = t.number_or("wall_m", {0.01, 10}, spec.wall_m);
  spec.furniture_per_room = t.number_or("furniture_per_room", {0, 100}, spec.furniture_per_room);
  // Without a material of the user's the walls and pieces of furniture keep those they are made with.
  std::optional<raycast::Material> material;
  if (t.has("material")) material = material_of(t, materials);
  t.refuse_unknown_keys();
  const auto most_pieces = static_cast<double>(limits.most_pieces);
  const double rooms = spec.width_m * spec.depth_m / (spec.room_m * spec.room_m);
  if (rooms > most_pieces / kPiecesPerRoom)
    t.fail("room_m", "the building would have more than " +
                         std::to_string(limits.most_pieces / static_cast<std::int64_t>(kPiecesPerRoom)) + " rooms");
  if (std::max(rooms, 1.0) * spec.furniture_per_room > most_pieces)
    t.fail("furniture_per_room",
           "the building would have more than " + std::to_string(limits.most_pieces) + " pieces of furniture");
  try {
    raycast::World building = make_building(spec);
    const auto append = [&](auto& to, auto& from) {
      for (auto& shape : from) {
        if (material) shape.material = *material;
        to.push_back(std::move(shape));
      }
    };
    append(world.walls, building.walls);
    append(world.boxes, building.boxes);
    append(world.circles, building.circles);
    append(world.polygons, building.polygons);
  } catch (const std::invalid_argument& e) {
    t.fail("", e.what());
  }
}

}  // namespace

void read_world_files(Table& table, const Materials& materials, const std::filesystem::path& base,
                      const SceneLimits& limits, raycast::World& world) {
  const auto check = [&](Table& t) {
    std::size_t corners = 2 * world.walls.size();
    for (const raycast::Polygon& p : world.polygons) corners += p.vertices.size();
    if (corners > kMostCorners) t.fail("file", "the world would have more than 20 million corners");
  };
  if (!limits.files) refuse(table, {"plans", "meshes"}, "this scene must not read files");
  for (Table& t : table.tables("plans", kMostFiles)) {
    read_plan(t, materials, base, world);
    check(t);
  }
  for (Table& t : table.tables("meshes", kMostFiles)) {
    read_mesh(t, materials, base, world);
    check(t);
  }
  if (table.has("building")) read_building(table.table("building"), materials, limits, world);
}

}  // namespace evigrid::scenes
