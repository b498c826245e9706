// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>

#include "mesh/collect.hpp"
#include "plan/readers.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 32;  // of a file

}  // namespace

Mesh load_mesh_bytes(std::span<const std::byte> bytes, std::string_view extension, std::string_view name) {
  std::string kind(extension);
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (kind == ".obj") return read_obj(bytes, name);
  if (kind == ".ply") return read_ply(bytes, name);
  throw SceneError(std::string(name) + ": a mesh is a file .ply or .obj, not \"" + kind + "\"");
}

Mesh load_mesh(const std::filesystem::path& file) {
  return load_mesh_bytes(read_bytes(file, kMostBytes), file.extension().string(), file.string());
}

}  // namespace evigrid::scenes
