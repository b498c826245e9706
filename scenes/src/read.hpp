// SPDX-License-Identifier: Apache-2.0
// The parts of a scene file, each read by its own function.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "document.hpp"
#include "evigrid/scenes/scene.hpp"

namespace evigrid::scenes {

using Materials = std::map<std::string, raycast::Material>;

/// [material.NAME].
Materials read_materials(Table table);

/// The material a shape names; the one that echoes everywhere when it names none.
raycast::Material material_of(Table& shape, const Materials& materials);

/// [[walls]], [[boxes]], [[circles]] and [[polygons]] of a table: of the world, or of a mover in its own frame.
raycast::World read_shapes(Table& table, const Materials& materials);

/// [material.NAME] and [world]. Files named there are found from the folder `base` on.
raycast::World read_world(Table& root, const std::filesystem::path& base, const SceneLimits& limits);

/// [[world.plans]], [[world.meshes]] and [world.building]: added to `world`.
void read_world_files(Table& table, const Materials& materials, const std::filesystem::path& base,
                      const SceneLimits& limits, raycast::World& world);

/// [robot]: radius_m, [robot.sensor] (defaults), [robot.ring], [[robot.sonar]], [[robot.laser]], [robot.echo],
/// [robot.odometry], into the scene.
void read_robot(Table robot, Scene& scene, const Vocabulary& words);

/// Complains of a name that is not among the known ones, unless there are none.
void require_known(Table& t, const char* key, const std::string& name, const std::vector<std::string>& known);

/// [trajectory]; a tour is planned through the scene's world.
TrajectorySpec read_trajectory(Table t, const Scene& scene, const SceneLimits& limits);

/// [[mover]].
std::vector<MoverSpec> read_movers(Table& root, const Materials& materials);

/// Waypoints or legs of constant velocity, and a start: what robots and movers share.
void read_route(Table& t, TrajectorySpec& run);

/// Puts what [robot] use names under what the scene's [robot] says itself: tables merge, everything else of the scene
/// outranks the robot's.
void merge_robot(toml::table& document, const std::string& file, const std::filesystem::path& base,
                 const SceneLimits& limits);

/// A whole file, at most 64 MiB of it even if it has no end. Throws SceneError.
std::string read_text(const std::filesystem::path& path);

/// Throws SceneError with the place of the fault, also for keys of more than 64 parts: the parser and the tables'
/// destructors go down one call a part, and a file could exhaust the stack.
toml::table parse_toml(std::string_view text, const std::string& file);

}  // namespace evigrid::scenes
