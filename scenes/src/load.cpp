// SPDX-License-Identifier: Apache-2.0
// From text to a Scene, or to a message with the place of the fault.
#include <fstream>
#include <iterator>

#include "read.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::size_t kMostBytes = 64u << 20;

MapSpec read_map(Table t) {
  MapSpec map{.cell_m = t.number("cell_m", {1e-3, 100}), .rule = t.text("rule")};
  t.refuse_unknown_keys();
  return map;
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& e) {
    throw SceneError(file + ":" + std::to_string(e.source().begin.line) + ": toml: " + std::string(e.description()));
  }
}

std::string read_text(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw SceneError(name + ": there is no such file");
  if (std::filesystem::is_directory(path, error)) throw SceneError(name + ": is a folder, not a scene file");
  const auto bytes = std::filesystem::file_size(path, error);
  if (!error && bytes > kMostBytes) throw SceneError(name + ": is larger than 64 MiB");
  std::ifstream in(path, std::ios::binary);
  std::string text;
  text.assign(std::istreambuf_iterator<char>(in), {});
  if (!in.good() && !in.eof()) throw SceneError(name + ": cannot be read");
  if (text.empty()) throw SceneError(name + ": is empty");
  return text;
}

Scene parse_scene(std::string_view text, std::string_view name) {
  const std::string file(name);
  const std::filesystem::path base = std::filesystem::path(file).parent_path();
  toml::table document = parse_toml(text, file);
  merge_robot(document, file, base);
  Table root(document, file, "");
  Scene scene;
  scene.name = root.text_or("name", "scene");
  scene.map = read_map(root.table("map"));
  scene.world = read_world(root, base);
  scene.movers = read_movers(root, read_materials(root.table_or_empty("material")));
  read_robot(root.table("robot"), scene);
  scene.trajectory = read_trajectory(root.table("trajectory"), scene);
  root.refuse_unknown_keys();
  return scene;
}

Scene load_scene(const std::filesystem::path& path) { return parse_scene(read_text(path), path.string()); }

}  // namespace evigrid::scenes
