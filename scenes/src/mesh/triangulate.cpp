// SPDX-License-Identifier: Apache-2.0
// Ear clipping in the coordinate plane that the polygon's normal (Newell's sum) is nearest to. A fan would do for
// convex polygons only: on others its triangles overlap and the cut would show walls that are not there.
#include <cmath>

#include "mesh/collect.hpp"

namespace evigrid::scenes {
namespace {

struct Flat {
  double x, y;
};

double turn(const Flat& a, const Flat& b, const Flat& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

void triangulate(const std::vector<std::array<double, 3>>& vertices, std::span<const std::uint32_t> corners,
                 std::vector<std::array<std::uint32_t, 3>>& faces) {
  std::array<double, 3> normal{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto &a = vertices[corners[i]], &b = vertices[corners[(i + 1) % corners.size()]];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
      normal[k] += (a[u] - b[u]) * (a[v] + b[v]);
    }
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double sign = normal[axis] < 0 ? -1 : 1;  // now the polygon turns to the left
  std::vector<Flat> flat;
  for (const std::uint32_t corner : corners) flat.push_back({sign * vertices[corner][u], vertices[corner][v]});

  std::vector<std::size_t> ring(corners.size());
  for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = i;
  const auto is_ear = [&](std::size_t before, std::size_t tip, std::size_t after) {
    const Flat &a = flat[before], &b = flat[tip], &c = flat[after];
    if (!(turn(a, b, c) > 0)) return false;
    for (const std::size_t i : ring) {
      if (i == before || i == tip || i == after) continue;
      const Flat& p = flat[i];
      const bool at_corner = (p.x == a.x && p.y == a.y) || (p.x == b.x && p.y == b.y) || (p.x == c.x && p.y == c.y);
      if (!at_corner && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  };
  std::size_t at = 0;
  while (ring.size() > 3) {
    std::size_t tried = 0;
    const auto before = [&] { return ring[(at + ring.size() - 1) % ring.size()]; };
    const auto after = [&] { return ring[(at + 1) % ring.size()]; };
    while (tried < ring.size() && !is_ear(before(), ring[at], after())) {
      at = (at + 1) % ring.size();
      ++tried;
    }
    faces.push_back({corners[before()], corners[ring[at]], corners[after()]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
    at %= ring.size();
  }
  faces.push_back({corners[ring[0]], corners[ring[1]], corners[ring[2]]});
}

}  // namespace evigrid::scenes
