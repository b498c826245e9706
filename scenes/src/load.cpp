// SPDX-License-Identifier: Apache-2.0
// From text to a Scene, or to a message with the place of the fault.
#include <algorithm>
#include <fstream>

#include "read.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::size_t kMostBytes = 64u << 20, kPiece = 1u << 16;

MapSpec read_map(Table t, const Vocabulary& words) {
  MapSpec map{.cell_m = t.number("cell_m", {1e-3, 100}), .rule = t.text("rule")};
  require_known(t, "rule", map.rule, words.rules);
  if (t.has("false_reflection_m")) map.false_reflection_m = t.number("false_reflection_m", {0, 1000});
  map.decay_s = t.number_or("decay_s", {0, 1e9}, map.decay_s);
  t.refuse_unknown_keys();
  return map;
}

}  // namespace

std::string read_text(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw SceneError(name + ": there is no such file");
  if (std::filesystem::is_directory(path, error)) throw SceneError(name + ": is a folder, not a scene file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw SceneError(name + ": cannot be read");
  std::string text;  // piece by piece: a device or a pipe does not tell its size
  for (std::size_t had = 0; in && text.size() <= kMostBytes; had += static_cast<std::size_t>(in.gcount())) {
    text.resize(had + kPiece);
    in.read(text.data() + had, static_cast<std::streamsize>(kPiece));
    text.resize(had + static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) throw SceneError(name + ": cannot be read");
  if (text.size() > kMostBytes) throw SceneError(name + ": is larger than 64 MiB");
  if (text.empty()) throw SceneError(name + ": is empty");
  return text;
}

void require_known(Table& t, const char* key, const std::string& name, const std::vector<std::string>& known) {
  if (known.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
  std::string all;
  for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
  t.fail(key, "'" + name + "' is unknown, or not built yet, here; known: " + all);
}

Scene parse_scene(std::string_view text, std::string_view name, const Vocabulary& words, const SceneLimits& limits) {
  const std::string file(name);
  const std::filesystem::path base = std::filesystem::path(file).parent_path();
  toml::table document = parse_toml(text, file);
  merge_robot(document, file, base, limits);
  Table root(document, file, "");
  Scene scene;
  scene.name = root.text_or("name", "scene");
  scene.map = read_map(root.table("map"), words);
  scene.world = read_world(root, base, limits);
  scene.movers = read_movers(root, read_materials(root.table_or_empty("material")));
  read_robot(root.table("robot"), scene, words);
  scene.trajectory = read_trajectory(root.table("trajectory"), scene, limits);
  root.refuse_unknown_keys();
  return scene;
}

Scene load_scene(const std::filesystem::path& path, const Vocabulary& words, const SceneLimits& limits) {
  return parse_scene(read_text(path), path.string(), words, limits);
}

}  // namespace evigrid::scenes
