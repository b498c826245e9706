// SPDX-License-Identifier: Apache-2.0
// Solids for mesh tests, and PLY and OBJ texts written of them.
#pragma once
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "evigrid/scenes/mesh.hpp"

namespace evigrid::scenes::test {

using Vertex = std::array<double, 3>;

/// An upright prism over a counter-clockwise polygon; its sides are cut into `layers` bands, its caps are fans.
inline Mesh prism(const std::vector<raycast::Point>& base, double z0, double z1, int layers = 1) {
  Mesh mesh;
  const auto n = static_cast<std::uint32_t>(base.size());
  for (int k = 0; k <= layers; ++k)
    for (const auto& p : base) mesh.vertices.push_back({p.x_m, p.y_m, z0 + (z1 - z0) * k / layers});
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(layers); ++k)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = k * n + i, b = k * n + (i + 1) % n;
      mesh.faces.push_back({a, b, b + n});
      mesh.faces.push_back({a, b + n, a + n});
    }
  const std::uint32_t top = static_cast<std::uint32_t>(layers) * n;
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    mesh.faces.push_back({0, i + 1, i});
    mesh.faces.push_back({top, top + i, top + i + 1});
  }
  return mesh;
}

inline std::vector<raycast::Point> regular(int n, double radius_m, double phase = 0) {
  std::vector<raycast::Point> v;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n + phase;
    v.push_back({radius_m * std::cos(a), radius_m * std::sin(a)});
  }
  return v;
}

inline std::string obj_of(const Mesh& mesh) {
  std::ostringstream out;
  out.precision(17);
  for (const Vertex& v : mesh.vertices) out << "v " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
  for (const auto& f : mesh.faces) out << "f " << f[0] + 1 << ' ' << f[1] + 1 << ' ' << f[2] + 1 << '\n';
  return out.str();
}

template <class T>
void put(std::string& out, T value, bool big) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));  // the tests run on little-endian machines
  for (std::size_t i = 0; i < sizeof(T); ++i) out += bytes[big ? sizeof(T) - 1 - i : i];
}

/// Faces first, then edges nobody asks for, then vertices with a colour and a list between their coordinates.
inline std::string ply_of(const Mesh& mesh, const std::string& format) {
  std::ostringstream head;
  head << "ply\nformat " << format << " 1.0\ncomment made by a test\nobj_info nothing\n"
       << "element face " << mesh.faces.size() << "\nproperty uchar quality\nproperty list uchar uint vertex_indices\n"
       << "element edge 2\nproperty list ushort short ends\nproperty double weight\n"
       << "element vertex " << mesh.vertices.size()
       << "\nproperty double y\nproperty uchar red\nproperty list int float extra\nproperty double x\nproperty double "
          "z\n"
       << "end_header\n";
  std::string out = head.str();
  if (format == "ascii") {
    std::ostringstream body;
    body.precision(17);
    for (const auto& f : mesh.faces) body << "7 3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
    body << "2 -1 5 0.5\n0 1e3\n";
    for (const Vertex& v : mesh.vertices) body << v[1] << " 255 2 0.5 nan " << v[0] << ' ' << v[2] << '\n';
    return out + body.str();
  }
  const bool big = format == "binary_big_endian";
  for (const auto& f : mesh.faces) {
    put<std::uint8_t>(out, 7, big);
    put<std::uint8_t>(out, 3, big);
    for (const std::uint32_t i : f) put(out, i, big);
  }
  put<std::uint16_t>(out, 2, big);
  put<std::int16_t>(out, -1, big);
  put<std::int16_t>(out, 5, big);
  put(out, 0.5, big);
  put<std::uint16_t>(out, 0, big);
  put(out, 1e3, big);
  for (const Vertex& v : mesh.vertices) {
    put(out, v[1], big);
    put<std::uint8_t>(out, 255, big);
    put<std::int32_t>(out, 2, big);
    put(out, 0.5f, big);
    put(out, 1.5f, big);
    put(out, v[0], big);
    put(out, v[2], big);
  }
  return out;
}

inline Mesh load(const std::string& text, const std::string& extension) {
  return load_mesh_bytes(std::as_bytes(std::span(text)), extension, "mesh" + extension);
}

}  // namespace evigrid::scenes::test
