// SPDX-License-Identifier: Apache-2.0
// A triangle mesh cut by the plane in which the sensors look: walls of the flat world. PLY (ASCII, binary of both byte
// orders) and OBJ.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "evigrid/raycast/world.hpp"
#include "evigrid/scenes/scene.hpp"

namespace evigrid::scenes {

struct Mesh {
  std::vector<std::array<double, 3>> vertices;      ///< in the units of the file
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< polygons are cut into triangles; every index is valid
};

/// By extension, .ply or .obj. Throws SceneError naming file and line (or byte). Of an OBJ only vertices and faces are
/// read; material files are not opened. Relative (negative) indices of an OBJ count back from the last vertex.
[[nodiscard]] Mesh load_mesh(const std::filesystem::path& file);

/// Same from memory; extension ".ply" or ".obj"; `name` stands for the file name in messages.
[[nodiscard]] Mesh load_mesh_bytes(std::span<const std::byte> bytes, std::string_view extension, std::string_view name);

struct MeshPlacement {
  double scale = 1;       ///< metres per unit of the file
  double height_m = 0.3;  ///< of the cut above the mesh's origin, after scaling
  Pose T_map_mesh{};
  bool y_up = false;  ///< the file's y axis points up (usual for OBJ): turned so that z does
  raycast::Material material{};
};

/// Straight walls where the mesh meets the plane. Pieces that continue one another in a straight line are joined, and a
/// piece that comes twice is kept once. A vertex at the very height counts as above it, so that the outline of a closed
/// mesh is closed and faces within the plane give nothing. Tolerance: 2^-22 of the mesh's size, the rounding of a file
/// in float. Throws std::invalid_argument for a placement or an index that cannot be and
/// for a mesh that reaches farther than 1e12 m.
[[nodiscard]] std::vector<raycast::Wall> slice(const Mesh& mesh, const MeshPlacement& placement);

}  // namespace evigrid::scenes
