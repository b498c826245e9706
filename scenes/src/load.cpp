// SPDX-License-Identifier: Apache-2.0
// From text to a Scene, or to a message with the place of the fault.
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "read.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::size_t kMostBytes = 64u << 20;
constexpr std::size_t kMostSteps = 1'000'000;

MapSpec read_map(Table t) {
  MapSpec map{.cell_m = t.number("cell_m", {1e-3, 100}), .rule = t.text("rule")};
  t.refuse_unknown_keys();
  return map;
}

TrajectorySpec read_trajectory(Table t) {
  TrajectorySpec run;
  run.waypoints = t.points("waypoints", 1, 100'000);
  run.speed_m_s = t.number_or("speed_m_s", {0, 100, true}, run.speed_m_s);
  run.turn_rate_rad_s = t.angle_or("turn_rate_deg_s", {0, 36000, true}, run.turn_rate_rad_s);
  run.period_s = t.number_or("period_s", {1e-3, 3600}, run.period_s);
  run.seed = static_cast<std::uint64_t>(t.integer("seed", 0, std::numeric_limits<std::int64_t>::max()));
  t.refuse_unknown_keys();
  // A turn is at most half a circle.
  double time_s = 0;
  for (std::size_t i = 1; i < run.waypoints.size(); ++i) {
    const raycast::Point &a = run.waypoints[i - 1], &b = run.waypoints[i];
    time_s += std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) / run.speed_m_s + 3.15 / run.turn_rate_rad_s;
  }
  if (time_s / run.period_s > static_cast<double>(kMostSteps))
    t.fail("waypoints", "the run would have more than " + std::to_string(kMostSteps) + " steps");
  return run;
}

}  // namespace

Scene parse_scene(std::string_view text, std::string_view name) {
  const std::string file(name);
  toml::table document;
  try {
    document = toml::parse(text, name);
  } catch (const toml::parse_error& e) {
    throw SceneError(file + ":" + std::to_string(e.source().begin.line) + ": toml: " + std::string(e.description()));
  }
  Table root(document, file, "");
  Scene scene;
  scene.name = root.text_or("name", "scene");
  scene.map = read_map(root.table("map"));
  scene.world = read_world(root);
  scene.sonars = read_robot(root.table("robot"));
  scene.trajectory = read_trajectory(root.table("trajectory"));
  root.refuse_unknown_keys();
  return scene;
}

Scene load_scene(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw SceneError(name + ": there is no such file");
  if (std::filesystem::is_directory(path, error)) throw SceneError(name + ": is a folder, not a scene file");
  std::ifstream in(path, std::ios::binary);
  std::string text;
  text.assign(std::istreambuf_iterator<char>(in), {});
  if (!in.good() && !in.eof()) throw SceneError(name + ": cannot be read");
  if (text.empty()) throw SceneError(name + ": is empty");
  if (text.size() > kMostBytes) throw SceneError(name + ": is larger than 64 MiB");
  return parse_scene(text, name);
}

}  // namespace evigrid::scenes
