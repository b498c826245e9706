// SPDX-License-Identifier: Apache-2.0
// Defaults of a bare world: a laser that sees all around, 0.5 m/s, five scans a second, a tour that keeps 5 cm
// more than the robot's radius away from every wall.
#include "world_input.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "error.hpp"
#include "evigrid/scenes/building.hpp"
#include "evigrid/scenes/mesh.hpp"
#include "evigrid/scenes/plan.hpp"
#include "evigrid/scenes/tour.hpp"
#include "evigrid/scenes/truth.hpp"
#include "log/line_reader.hpp"
#include "widest_place.hpp"

namespace evigrid::driver {
namespace {

constexpr double kMargin_m = 0.05, kPeriod_s = 0.2;
constexpr double kLaserCell_m = 0.05, kSonarCell_m = 0.1;

std::string extension(const std::string& path) {
  std::string end = std::filesystem::path(path).extension().string();
  std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
  return end;
}

/// `plan` is kept when the world is one.
raycast::World load_world(const WorldOptions& o, std::optional<scenes::FloorPlan>& plan) {
  if (o.resolution_m && !(*o.resolution_m > 0 && *o.resolution_m <= 1000))
    throw InputError(fmt::format("--resolution: {} is not within (0, 1000]", *o.resolution_m));
  raycast::World world;
  const std::string end = extension(o.world);
  const bool mesh = end == ".ply" || end == ".obj";
  if (o.height_m && !mesh) throw InputError("--height: is for meshes");
  if (!o.up.empty() && !mesh) throw InputError("--up: is for meshes");
  if (!o.up.empty() && o.up != "y" && o.up != "z") throw InputError(fmt::format("--up: '{}' is neither y nor z", o.up));
  const bool image = !mesh && o.world != "building" && end != ".yaml" && end != ".yml" && end != ".map";
  std::error_code error;
  if (o.world != "building" && !std::filesystem::is_regular_file(o.world, error))  // else it would be asked for scales
    throw InputError(o.world + (std::filesystem::exists(o.world, error) ? ": is no file" : ": there is no such file"));
  if (image && !o.resolution_m)
    throw InputError(fmt::format("--resolution: is missing, the m per pixel of {}", o.world));
  if (o.resolution_m && o.world == "building") throw InputError("--resolution: is for images and meshes");
  if (o.world == "building") {
    scenes::BuildingSpec building;
    if (o.seed) building.seed = static_cast<std::uint64_t>(*o.seed);
    world = scenes::make_building(building);
  } else if (mesh) {
    scenes::MeshPlacement placement;
    placement.scale = o.resolution_m.value_or(placement.scale);
    placement.height_m = o.height_m.value_or(placement.height_m);
    placement.y_up = o.up.empty() ? end == ".obj" : o.up == "y";
    world.walls = scenes::slice(scenes::load_mesh(o.world), placement);
  } else {
    scenes::ImageScale scale;
    scale.resolution_m = o.resolution_m;
    // The tour must not leave what the plan knows by a gap in a wall.
    const scenes::TraceOptions closed{.unknown_is_wall = true, .border_is_wall = true};
    plan = scenes::load_plan(o.world, scale);
    if (std::find(plan->cells.begin(), plan->cells.end(), scenes::PlanCell::free) == plan->cells.end())
      throw InputError(fmt::format("{}: no pixel of the plan is free", o.world));
    world.polygons = scenes::trace(*plan, closed);
  }
  if (world.walls.empty() && world.boxes.empty() && world.circles.empty() && world.polygons.empty())
    throw InputError(fmt::format("{}: holds no wall", o.world));
  return world;
}

/// "x,y" or "x,y,yaw_deg".
scenes::Pose parse_start(const std::string& text, bool& with_yaw) {
  constexpr double kFarthest = 1e7;
  std::vector<double> parts;
  bool good = true;
  for (std::size_t at = 0; good && at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    double value = 0;
    good = parse_number(std::string_view(text).substr(at, comma - at), value) && std::abs(value) <= kFarthest;
    parts.push_back(value);
    at = comma + 1;
  }
  if (!good || parts.size() < 2 || parts.size() > 3)
    throw InputError(fmt::format("--start: '{}' is not x,y or x,y,yaw_deg", text));
  with_yaw = parts.size() == 3;
  return {parts[0], parts[1], with_yaw ? parts[2] * std::numbers::pi / 180 : 0};
}

void add_tour(scenes::Scene& scene, const WorldOptions& o, const std::optional<scenes::FloorPlan>& plan) {
  scenes::TourSpec tour;
  tour.clearance_m = scene.radius_m + kMargin_m;
  bool with_yaw = false;
  try {
    if (o.start.empty()) {
      const auto widest = plan ? widest_place(*plan, tour.clearance_m) : std::nullopt;
      tour.start = widest ? *widest : scenes::find_start(scene.world, tour.clearance_m);
    } else {
      const scenes::Pose start = parse_start(o.start, with_yaw);
      tour.start = {start.x_m, start.y_m};
      const scenes::Extent box = scenes::extent(scene.world);
      if (start.x_m < box.low.x_m || start.x_m > box.high.x_m || start.y_m < box.low.y_m || start.y_m > box.high.y_m) {
        throw InputError(fmt::format(
            "--start: ({:g}, {:g}) lies outside of the world, which is [{:.3f}, {:.3f}] x [{:.3f}, {:.3f}] m",
            start.x_m, start.y_m, box.low.x_m, box.high.x_m, box.low.y_m, box.high.y_m));
      }
      if (with_yaw) scene.trajectory.start = start;
    }
    scene.trajectory.waypoints = scenes::make_tour(scene.world, tour);
  } catch (const std::invalid_argument& bad) {
    throw InputError(o.start.empty()
                         ? fmt::format("{}: no --start is given, and in the widest place {}; a --start or a "
                                       "smaller --robot may help",
                                       o.world, bad.what())
                         : fmt::format("--start: {}", bad.what()));
  } catch (const std::length_error& large) {
    throw InputError(fmt::format("{}: {}", o.world, large.what()));
  }
}

SceneInput open_world(const WorldOptions& o) {
  SceneInput input{o.world, {}};
  scenes::Scene& scene = input.scene;
  scene.name = std::filesystem::path(o.world).stem().string();
  std::optional<scenes::FloorPlan> plan;
  scene.world = load_world(o, plan);
  scenes::use_robot(scene, o.robot.empty() ? "laser360" : o.robot, vocabulary());
  scene.map.cell_m = scene.lasers.empty() ? kSonarCell_m : kLaserCell_m;
  scene.trajectory.period_s = kPeriod_s;
  scene.trajectory.seed = static_cast<std::uint64_t>(o.seed.value_or(1));
  add_tour(scene, o, plan);
  return input;
}

}  // namespace

void add_world_options(CLI::App& command, WorldOptions& o) {
  command.add_option("SCENE", o.scene,
                     "scene file (TOML), or an embedded scene: " + embedded_scene_names() + "; without one: default");
  command.add_option("--world", o.world,
                     "instead of a scene: a floor plan (yaml, map, pgm, png, bmp), a mesh (ply, obj), or 'building'");
  command.add_option("--robot", o.robot, "robot by name or .toml file (default: the scene's; laser360 in a --world)");
  command.add_option("--start", o.start, "x,y or x,y,yaw_deg in a --world (default: in its widest place)");
  command.add_option("--resolution", o.resolution_m, "m per pixel of a --world image, m per unit of a mesh");
  command.add_option("--height", o.height_m, "m above the origin of a --world mesh where it is cut");
  command.add_option("--up", o.up, "y or z: which axis of a --world mesh points up (default: y in .obj, z in .ply)");
  command.add_option("--seed", o.seed, "of noise and of --world building (default: the scene's; 1)");
}

void refuse_world_options(const WorldOptions& o) {
  for (const auto& [given, name] : {std::pair{!o.start.empty(), "--start"},
                                    {o.resolution_m.has_value(), "--resolution"},
                                    {o.height_m.has_value(), "--height"},
                                    {!o.up.empty(), "--up"}}) {
    if (given) throw InputError(fmt::format("{}: is for --world", name));
  }
}

SceneInput open_input(const WorldOptions& o) {
  if (o.seed && *o.seed < 0) throw InputError(fmt::format("--seed: {} is below 0", *o.seed));
  try {
    if (!o.world.empty()) {
      if (!o.scene.empty()) throw InputError("--world: cannot be given beside a scene");
      return open_world(o);
    }
    refuse_world_options(o);
    SceneInput input = open_scene(o.scene);
    if (!o.robot.empty()) scenes::use_robot(input.scene, o.robot, vocabulary());
    if (o.seed) input.scene.trajectory.seed = static_cast<std::uint64_t>(*o.seed);
    return input;
  } catch (const scenes::SceneError& error) {
    throw InputError(error.what());
  } catch (const std::invalid_argument& bad) {
    throw InputError(fmt::format("{}: {}", o.world, bad.what()));
  } catch (const std::length_error& large) {
    throw InputError(fmt::format("{}: {}", o.world, large.what()));
  }
}

}  // namespace evigrid::driver
