// SPDX-License-Identifier: Apache-2.0
// A triangle mesh cut by the plane in which the sensors look: walls of the flat world. PLY (ASCII, binary of both byte
// orders) and OBJ.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "evigrid/raycast/world.hpp"
#include "evigrid/scenes/scene.hpp"

namespace evigrid::scenes {

struct Mesh {
  std::vector<std::array<double, 3>> vertices;      ///< in the units of the file
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< polygons are cut into triangles; every index is valid
};

/// By extension, .ply or .obj. Throws SceneError naming file and line (or byte).
[[nodiscard]] Mesh load_mesh(const std::filesystem::path& file);

struct MeshPlacement {
  double scale = 1;      ///< metres per unit of the file
  double height_m = 0.3;  ///< of the cut above the mesh's origin, after scaling
  Pose T_map_mesh{};
  bool y_up = false;     ///< the file's y axis points up (usual for OBJ): turned so that z does
  raycast::Material material{};
};

/// Straight walls where the mesh meets the plane; pieces on one line that touch are joined.
[[nodiscard]] std::vector<raycast::Wall> slice(const Mesh& mesh, const MeshPlacement& placement);

}  // namespace evigrid::scenes
