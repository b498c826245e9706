// SPDX-License-Identifier: Apache-2.0
// Triangles ∩ plane. A vertex is above when z ≥ height, else below, so a triangle has a piece exactly when it has both.
// The crossing of an edge is computed from its lower to its upper vertex, whichever triangle asks: neighbours agree in
// the last bit and outlines close.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "evigrid/scenes/mesh.hpp"
#include "mesh/collect.hpp"
#include "mesh/join.hpp"

namespace evigrid::scenes {
namespace {

using Vertex = std::array<double, 3>;
using raycast::Point;

void require_finite(double value, const char* field) {
  if (!std::isfinite(value)) throw std::invalid_argument(std::string(field) + " is not finite");
}

void check(const MeshPlacement& p) {
  if (!(p.scale > 0) || !std::isfinite(p.scale)) throw std::invalid_argument("scale is not positive");
  require_finite(p.height_m, "height_m");
  require_finite(p.T_map_mesh.x_m, "T_map_mesh.x_m");
  require_finite(p.T_map_mesh.y_m, "T_map_mesh.y_m");
  require_finite(p.T_map_mesh.yaw_rad, "T_map_mesh.yaw_rad");
}

Point crossing(const Vertex& below, const Vertex& above, double height) {
  if (above[2] == height) return {above[0], above[1]};
  const double t = (height - below[2]) / (above[2] - below[2]);
  return {below[0] + t * (above[0] - below[0]), below[1] + t * (above[1] - below[1])};
}

}  // namespace

std::vector<raycast::Wall> slice(const Mesh& mesh, const MeshPlacement& placement) {
  check(placement);
  const double scale = placement.scale, height = placement.height_m;
  Vertex low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  std::vector<Vertex> vertices = mesh.vertices;
  for (Vertex& v : vertices) {
    if (placement.y_up) v = {v[0], -v[2], v[1]};  // a quarter turn about x
    for (std::size_t k = 0; k < 3; ++k) {
      v[k] *= scale;
      if (!(std::abs(v[k]) <= kFarthest)) throw std::invalid_argument("the mesh reaches farther than 1e12 m");
      low[k] = std::min(low[k], v[k]);
      high[k] = std::max(high[k], v[k]);
    }
  }

  std::vector<LinePiece> pieces;
  for (const auto& face : mesh.faces) {
    for (const std::uint32_t index : face)
      if (index >= vertices.size()) throw std::invalid_argument("a face of the mesh names a vertex that is not there");
    // Turned so that the first vertex is alone on its side of the plane.
    Vertex a = vertices[face[0]], b = vertices[face[1]], c = vertices[face[2]];
    const bool above_a = a[2] >= height, above_b = b[2] >= height, above_c = c[2] >= height;
    if (above_a == above_b && above_b == above_c) continue;
    if (above_a == above_c) std::swap(a, b);
    if (above_a == above_b) std::swap(a, c);
    const bool alone_above = a[2] >= height;
    const Point p = alone_above ? crossing(b, a, height) : crossing(a, b, height);
    const Point q = alone_above ? crossing(c, a, height) : crossing(a, c, height);
    if (p.x_m != q.x_m || p.y_m != q.y_m) pieces.emplace_back(p, q);
  }
  if (pieces.empty()) return {};

  const double size = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  const double c = std::cos(placement.T_map_mesh.yaw_rad), s = std::sin(placement.T_map_mesh.yaw_rad);
  const auto to_map = [&](Point p) {
    return Point{placement.T_map_mesh.x_m + c * p.x_m - s * p.y_m, placement.T_map_mesh.y_m + s * p.x_m + c * p.y_m};
  };
  std::vector<raycast::Wall> walls;
  for (const LinePiece& piece : join(pieces, size * 0x1p-22))
    walls.push_back({to_map(piece.first), to_map(piece.second), placement.material});
  return walls;
}

}  // namespace evigrid::scenes
