// SPDX-License-Identifier: Apache-2.0
// Robots that are described once: [robot] use = "hughes24" or use = "my_robot.toml". A robot file looks as the [robot]
// part of a scene does, and its nodes keep the file and the line that they came from, for messages.
#include <functional>

#include "read.hpp"

namespace evigrid::scenes {
namespace {

toml::table robot_document(const std::string& wanted, const std::filesystem::path& base, const SceneLimits& limits,
                           const std::function<void(const std::string&)>& complain) {
  if (wanted.ends_with(".toml")) {
    if (!limits.files) complain("this scene must not read files");
    const std::filesystem::path path = base / wanted;
    std::error_code error;
    if (!std::filesystem::exists(path, error)) complain("there is no such file: " + path.string());
    return parse_toml(read_text(path), path.string());
  }
  const std::string_view text = find_embedded(embedded_robots(), wanted);
  if (text.empty()) {
    std::string known;
    for (const Embedded& robot : embedded_robots()) known.append(known.empty() ? "" : ", ").append(robot.name);
    complain("there is no robot '" + wanted + "' (a file's name ends in .toml); known: " + known);
  }
  return parse_toml(text, "(embedded robot " + wanted + ")");
}

/// What `over` does not say is taken from `under`. Nodes are moved: a copy would forget its line.
void put_under(toml::table& over, toml::table&& under) {
  for (auto&& [key, node] : under) {
    toml::node* mine = over.get(key.str());
    if (!mine) {
      std::move(node).visit(
          [&, &k = key](auto&& value) { over.insert_or_assign(k, std::forward<decltype(value)>(value)); });
    } else if (mine->is_table() && node.is_table()) {
      put_under(*mine->as_table(), std::move(*node.as_table()));
    }
  }
}

/// The [robot] table of a robot file, which holds nothing else but a name.
toml::table take_robot(toml::table&& document, const std::string& file) {
  Table root(document, file, "");
  (void)root.text_or("name", "");
  Table robot = root.table("robot");
  root.refuse_unknown_keys();
  if (robot.has("use")) robot.fail("use", "a robot file cannot use another robot");
  return std::move(*document.get("robot")->as_table());
}

toml::table load_robot(const std::string& wanted, const std::filesystem::path& base, const SceneLimits& limits,
                       const std::function<void(const std::string&)>& complain) {
  toml::table document = robot_document(wanted, base, limits, complain);
  const std::string file = document.source().path ? *document.source().path : wanted;
  return take_robot(std::move(document), file);
}

}  // namespace

void merge_robot(toml::table& document, const std::string& file, const std::filesystem::path& base,
                 const SceneLimits& limits) {
  toml::table* robot = document["robot"].as_table();
  if (!robot || !robot->contains("use")) return;  // no table at all: whoever reads it complains
  Table reader(*robot, file, "robot");
  const std::string wanted = reader.text("use");
  toml::table under =
      load_robot(wanted, base, limits, [&](const std::string& message) { reader.fail("use", message); });
  robot->erase("use");
  put_under(*robot, std::move(under));
}

void use_robot(Scene& scene, const std::string& name_or_file, const Vocabulary& words) {
  const toml::table robot =
      load_robot(name_or_file, {}, {}, [](const std::string& message) { throw SceneError("robot: " + message); });
  const std::string file = robot.source().path ? *robot.source().path : name_or_file;
  read_robot(Table(robot, file, "robot"), scene, words);
}

}  // namespace evigrid::scenes
