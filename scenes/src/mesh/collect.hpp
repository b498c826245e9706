// SPDX-License-Identifier: Apache-2.0
// What both mesh readers fill: vertices and faces of any number of corners. Faces may come before their vertices, so
// indices are checked, and polygons cut, at the end.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "evigrid/scenes/mesh.hpp"

namespace evigrid::scenes {

/// Of a coordinate, in the units of the file: products of differences stay finite, and what is cut sorts by them.
inline constexpr double kFarthest = 1e12;
inline constexpr std::size_t kMostCorners = 2048;  // of one face: cutting takes time with the square

class MeshCollector {
 public:
  /// `place` says "line" or "byte": what `where` counts below.
  MeshCollector(std::string_view name, std::string_view place) : name_(name), place_(place) {}

  std::vector<std::array<double, 3>>& vertices() { return mesh_.vertices; }

  /// Indices from 0. Throws SceneError when there are fewer than three or one is negative.
  void add_face(std::span<const std::int64_t> corners, std::uint64_t where);

  /// Throws SceneError when an index is too large or there is no face.
  [[nodiscard]] Mesh finish();

  [[noreturn]] void fail(std::uint64_t where, std::string_view field, const std::string& message) const;

 private:
  std::string name_, place_;
  Mesh mesh_;
  std::vector<std::uint32_t> corners_;  // of the faces with more than three
  std::vector<std::uint32_t> counts_;
  std::int64_t greatest_ = -1;  // index so far, and where it stands
  std::uint64_t greatest_where_ = 0;
};

/// Cuts a polygon into triangles by clipping ears in its plane; a polygon that crosses itself is cut somehow.
void triangulate(const std::vector<std::array<double, 3>>& vertices, std::span<const std::uint32_t> corners,
                 std::vector<std::array<std::uint32_t, 3>>& faces);

[[nodiscard]] Mesh read_obj(std::span<const std::byte> bytes, std::string_view name);
[[nodiscard]] Mesh read_ply(std::span<const std::byte> bytes, std::string_view name);

}  // namespace evigrid::scenes
