// SPDX-License-Identifier: Apache-2.0
#include "mesh/collect.hpp"

#include <utility>

namespace evigrid::scenes {

void MeshCollector::fail(std::uint64_t where, std::string_view field, const std::string& message) const {
  // Lines as everywhere, `file:7: …`; bytes are named.
  const std::string at = place_ == "line" ? std::to_string(where) : place_ + " " + std::to_string(where);
  throw SceneError(name_ + ":" + at + ": " + std::string(field) + ": " + message);
}

void MeshCollector::add_face(std::span<const std::int64_t> corners, std::uint64_t where) {
  if (corners.size() < 3) fail(where, "face", "has " + std::to_string(corners.size()) + " corners");
  if (corners.size() > kMostCorners) fail(where, "face", "has more than " + std::to_string(kMostCorners) + " corners");
  for (const std::int64_t index : corners) {
    if (index < 0) fail(where, "face", "a vertex index is out of range");
    if (index <= greatest_) continue;
    if (index > 0xfffffffe) fail(where, "face", "a vertex index is out of range");
    greatest_ = index;
    greatest_where_ = where;
  }
  const auto corner = [&](std::size_t i) { return static_cast<std::uint32_t>(corners[i]); };
  if (corners.size() == 3) {
    mesh_.faces.push_back({corner(0), corner(1), corner(2)});
    return;
  }
  for (std::size_t i = 0; i < corners.size(); ++i) corners_.push_back(corner(i));
  counts_.push_back(static_cast<std::uint32_t>(corners.size()));
}

Mesh MeshCollector::finish() {
  if (greatest_ < 0) throw SceneError(name_ + ": the mesh has no faces");
  if (static_cast<std::uint64_t>(greatest_) >= mesh_.vertices.size())
    fail(greatest_where_, "face",
         "a vertex index is out of range: the mesh has " + std::to_string(mesh_.vertices.size()) + " vertices");
  std::size_t at = 0;
  for (const std::uint32_t count : counts_) {
    triangulate(mesh_.vertices, std::span(corners_).subspan(at, count), mesh_.faces);
    at += count;
  }
  return std::move(mesh_);
}

}  // namespace evigrid::scenes
