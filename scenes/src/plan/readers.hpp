// SPDX-License-Identifier: Apache-2.0
// The two text formats of a plan, and files as bytes.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "image.hpp"

namespace evigrid::scenes {

/// What a ROS map_server yaml says about its image.
struct MapYaml {
  std::filesystem::path image;  ///< found from the yaml's folder on
  double resolution_m = 0;
  Pose origin{};
  Shading shading{};
};

/// Throws SceneError "name:line: field: ...".
MapYaml read_map_yaml(Bytes bytes, const std::filesystem::path& name);

/// Octile maps of the MovingAI benchmarks. Throws SceneError "name:line: ...".
Bitmap read_movingai(Bytes bytes, const std::string& name);

/// A regular, non-empty file of at most `most` bytes. Throws SceneError "path: ...".
std::vector<std::byte> read_bytes(const std::filesystem::path& path, std::uintmax_t most);

}  // namespace evigrid::scenes
