// SPDX-License-Identifier: Apache-2.0
// ROS map_server yaml (wiki.ros.org/map_server, section "YAML format"; nav2_map_server the same): image, resolution in
// m/pixel, origin [x, y, yaw] of the lower left pixel in m and rad, negate, occupied_thresh, free_thresh, and
// optionally mode. All but mode are required, as there; other keys are left to newer versions.
#include <yaml-cpp/yaml.h>

#include <charconv>
#include <cmath>
#include <map>

#include "readers.hpp"

namespace evigrid::scenes {
namespace {

constexpr double kFarthest_m = 1e7, kCoarsest_m = 1e3;

class YamlMap {
 public:
  YamlMap(const YAML::Node& root, std::string name) : root_(root), name_(std::move(name)) {
    if (!root_.IsMap()) fail_at(1, "yaml", "is not a table of keys and values");
    for (const auto& entry : root_) {
      const int line = entry.first.Mark().line + 1;
      if (!entry.first.IsScalar()) fail_at(line, "yaml", "a key must be text");
      if (!lines_.emplace(entry.first.Scalar(), line).second) fail_at(line, entry.first.Scalar(), "is given twice");
    }
  }

  /// `field` may say more than its key, e.g. origin[1].
  [[noreturn]] void fail(const std::string& field, const std::string& message) const {
    const auto line = lines_.find(field.substr(0, field.find('[')));
    fail_at(line == lines_.end() ? 1 : line->second, field, message);
  }
  [[nodiscard]] bool has(const char* key) const { return lines_.contains(key); }
  [[nodiscard]] YAML::Node get(const char* key) const {
    if (!has(key)) fail(key, "is missing");
    return root_[key];
  }
  [[nodiscard]] std::string text(const char* key) const {
    const YAML::Node node = get(key);
    if (!node.IsScalar() || node.Scalar().empty()) fail(key, "must be text");
    return node.Scalar();
  }
  /// Whatever the locale.
  [[nodiscard]] double number(const YAML::Node& node, const std::string& field, double low, double high) const {
    const std::string scalar = node.IsScalar() ? node.Scalar() : "";
    const char *begin = scalar.data(), *end = begin + scalar.size();
    begin += begin != end && *begin == '+';
    double value = 0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || stop != end || begin == end) fail(field, "must be a number");
    if (!std::isfinite(value)) fail(field, "must be finite");
    if (value < low || value > high)
      fail(field, "is " + scalar + ", must be within [" + words(low) + ", " + words(high) + "]");
    return value;
  }
  [[nodiscard]] double number(const char* key, double low, double high) const {
    return number(get(key), key, low, high);
  }
  [[nodiscard]] bool flag(const char* key) const {
    const YAML::Node node = get(key);
    const std::string scalar = node.IsScalar() ? node.Scalar() : "";
    if (scalar == "1" || scalar == "true" || scalar == "True") return true;
    if (scalar == "0" || scalar == "false" || scalar == "False") return false;
    fail(key, "must be 0 or 1");
  }

 private:
  [[noreturn]] void fail_at(int line, const std::string& field, const std::string& message) const {
    throw SceneError(name_ + ":" + std::to_string(line) + ": " + field + ": " + message);
  }
  static std::string words(double value) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
  }

  YAML::Node root_;
  std::string name_;
  std::map<std::string, int> lines_;  ///< of each key
};

Pose read_origin(const YamlMap& map) {
  const YAML::Node origin = map.get("origin");
  if (!origin.IsSequence() || origin.size() != 3) map.fail("origin", "must be [x, y, yaw]");
  return {map.number(origin[0], "origin[0]", -kFarthest_m, kFarthest_m),
          map.number(origin[1], "origin[1]", -kFarthest_m, kFarthest_m), map.number(origin[2], "origin[2]", -1e3, 1e3)};
}

}  // namespace

MapYaml read_map_yaml(Bytes bytes, const std::filesystem::path& name) {
  const std::string file = name.string();
  try {
    const YamlMap map(YAML::Load(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())), file);
    MapYaml out;
    out.image = name.parent_path() / map.text("image");
    out.resolution_m = map.number("resolution", 0, kCoarsest_m);
    if (out.resolution_m < 1e-6) map.fail("resolution", "must be greater than 0 (1e-06 or more)");
    out.origin = read_origin(map);
    out.shading.negate = map.flag("negate");
    out.shading.occupied_threshold = map.number("occupied_thresh", 0, 1);
    out.shading.free_threshold = map.number("free_thresh", 0, 1);
    if (out.shading.free_threshold > out.shading.occupied_threshold)
      map.fail("free_thresh", "is greater than occupied_thresh");
    if (map.has("mode")) {
      const std::string mode = map.text("mode");
      if (mode == "scale")
        out.shading.mode = ShadeMode::scale;
      else if (mode == "raw")
        out.shading.mode = ShadeMode::raw;
      else if (mode != "trinary")
        map.fail("mode", "is " + mode + ", must be trinary, scale or raw");
    }
    return out;
  } catch (const YAML::Exception& e) {
    throw SceneError(file + ":" + std::to_string(std::max(e.mark.line, 0) + 1) + ": yaml: " + e.msg);
  }
}

}  // namespace evigrid::scenes
