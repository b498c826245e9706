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
raycast::World read_world(Table& root, const std::filesystem::path& base);

/// [[world.plans]], [[world.meshes]] and [world.building]: added to `world`.
void read_world_files(Table& table, const Materials& materials, const std::filesystem::path& base,
                      raycast::World& world);

/// [robot]: radius_m, [robot.sensor] (defaults), [robot.ring], [[robot.sonar]], [[robot.laser]], [robot.echo],
/// [robot.odometry], into the scene.
void read_robot(Table robot, Scene& scene);

/// [trajectory]; a tour is planned through the scene's world.
TrajectorySpec read_trajectory(Table t, const Scene& scene);

/// [[mover]].
std::vector<MoverSpec> read_movers(Table& root, const Materials& materials);

/// Waypoints or legs of constant velocity, and a start: what robots and movers share.
void read_route(Table& t, TrajectorySpec& run);

/// Puts what [robot] use names under what the scene's [robot] says itself: tables merge, everything else of the scene
/// outranks the robot's.
void merge_robot(toml::table& document, const std::string& file, const std::filesystem::path& base);

/// A whole file, at most 64 MiB. Throws SceneError.
std::string read_text(const std::filesystem::path& path);

/// Throws SceneError with the place of the fault.
toml::table parse_toml(std::string_view text, const std::string& file);

}  // namespace evigrid::scenes
