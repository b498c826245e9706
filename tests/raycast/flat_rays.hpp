// SPDX-License-Identifier: Apache-2.0
// Rays through a flat world by brute force, with normals: the plain idea of bouncing sound, for proving the caster. Own
// geometry and own wording of the physics, with angles instead of cross products.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "evigrid/raycast/cone.hpp"
#include "evigrid/raycast/world.hpp"

namespace evigrid::raycast::testing {

struct FlatHit {
  double range_m = INFINITY;
  Point at{}, normal{};  ///< unit
  Material material{};
  /// Angle between the normal (either side) and a direction.
  [[nodiscard]] double incidence_rad(double dx, double dy) const {
    return std::acos(std::min(1.0, std::abs(dx * normal.x_m + dy * normal.y_m)));
  }
};

class FlatRays {
 public:
  explicit FlatRays(const World& w) : circles_(w.circles) {
    lines_ = w.walls;
    const auto close = [&](const std::vector<Point>& v, const Material& m) {
      for (std::size_t i = 0; i < v.size(); ++i) lines_.push_back({v[i], v[(i + 1) % v.size()], m});
    };
    for (const Polygon& p : w.polygons) close(p.vertices, p.material);
    for (const Box& b : w.boxes) {
      std::vector<Point> v;
      for (int i = 0; i < 4; ++i) {
        const double l = (i == 0 || i == 3 ? 0.5 : -0.5) * b.length_m, h = (i < 2 ? 0.5 : -0.5) * b.width_m;
        v.push_back({b.centre.x_m + l * std::cos(b.yaw_rad) - h * std::sin(b.yaw_rad),
                     b.centre.y_m + l * std::sin(b.yaw_rad) + h * std::cos(b.yaw_rad)});
      }
      close(v, b.material);
    }
  }

  /// First surface more than `skip_m` along the ray.
  [[nodiscard]] FlatHit first(Point o, double dx, double dy, double skip_m = 0) const {
    FlatHit best;
    const auto take = [&](double t, Point normal, const Material& m) {
      if (t > skip_m && t < best.range_m) best = {t, {o.x_m + t * dx, o.y_m + t * dy}, normal, m};
    };
    for (const Wall& l : lines_) {
      const double ex = l.to.x_m - l.from.x_m, ey = l.to.y_m - l.from.y_m, size = std::hypot(ex, ey);
      const double wx = l.from.x_m - o.x_m, wy = l.from.y_m - o.y_m, det = ex * dy - ey * dx;
      const double t = (ex * wy - ey * wx) / det, u = (dx * wy - dy * wx) / det;
      if (u >= 0 && u <= 1) take(t, {-ey / size, ex / size}, l.material);
    }
    for (const Circle& c : circles_) {
      const double cx = o.x_m - c.centre.x_m, cy = o.y_m - c.centre.y_m, half = cx * dx + cy * dy;
      const double rest = half * half - (cx * cx + cy * cy - c.radius_m * c.radius_m);
      if (rest < 0) continue;
      for (double t : {-half - std::sqrt(rest), -half + std::sqrt(rest)})
        take(t, {(cx + t * dx) / c.radius_m, (cy + t * dy) / c.radius_m}, c.material);
    }
    return best;
  }

  /// Shortest way over one mirror, d1 + d2, that is heard; among `rays` directions of the cone.
  [[nodiscard]] double second_bounce(const ConeQuery& q, int rays) const {
    double best = INFINITY;
    for (int i = 0; i < rays; ++i) {
      const double a = q.yaw_rad + q.aperture_rad * (static_cast<double>(i) / (rays - 1) - 0.5);
      const double dx = std::cos(a), dy = std::sin(a);
      const FlatHit one = first({q.x_m, q.y_m}, dx, dy);
      if (std::isinf(one.range_m) || one.incidence_rad(dx, dy) <= one.material.critical_incidence_rad) continue;
      const double turn = 2 * (dx * one.normal.x_m + dy * one.normal.y_m);
      const double rx = dx - turn * one.normal.x_m, ry = dy - turn * one.normal.y_m;
      const FlatHit two = first(one.at, rx, ry, 1e-9);
      if (std::isinf(two.range_m) || two.incidence_rad(rx, ry) > two.material.critical_incidence_rad) continue;
      const double way = one.range_m + two.range_m, once = 1 - one.material.absorption;
      const double energy = once * once * (1 - two.material.absorption) / (way * way);
      if (energy >= 1 / (q.max_range_m * q.max_range_m)) best = std::min(best, way);
    }
    return best;
  }

  /// Half the shortest way speaker → surface → listener that is heard; among `rays` directions of the listener's cone.
  [[nodiscard]] double cross_talk(const ConeQuery& s, const ConeQuery& l, int rays) const {
    double best = INFINITY;
    for (int i = 0; i < rays; ++i) {
      const double a = l.yaw_rad + l.aperture_rad * (static_cast<double>(i) / (rays - 1) - 0.5);
      const double dx = std::cos(a), dy = std::sin(a);
      const FlatHit hit = first({l.x_m, l.y_m}, dx, dy);
      if (std::isinf(hit.range_m)) continue;
      const double sx = hit.at.x_m - s.x_m, sy = hit.at.y_m - s.y_m, spoken = std::hypot(sx, sy);
      if (std::abs(std::remainder(std::atan2(sy, sx) - s.yaw_rad, 2 * M_PI)) > s.aperture_rad / 2) continue;
      const double half_way = (spoken + hit.range_m) / 2, reach = std::min(s.max_range_m, l.max_range_m);
      if ((1 - hit.material.absorption) / (half_way * half_way) < 1 / (reach * reach)) continue;
      // Angles of both from the normal on the listener's side, with their signs.
      const double side = dx * hit.normal.x_m + dy * hit.normal.y_m < 0 ? 1 : -1;
      const double nx = side * hit.normal.x_m, ny = side * hit.normal.y_m;
      const auto from_normal = [&](double x, double y) { return std::atan2(nx * y - ny * x, nx * x + ny * y); };
      const double to_listener = from_normal(-dx, -dy), to_speaker = from_normal(-sx, -sy);
      if (std::abs(to_speaker) >= M_PI / 2) continue;
      if (std::abs(to_listener + to_speaker) / 2 > hit.material.critical_incidence_rad) continue;
      if (first({s.x_m, s.y_m}, sx / spoken, sy / spoken).range_m < spoken * (1 - 1e-9) - 1e-9) continue;
      best = std::min(best, half_way);
    }
    return best;
  }

 private:
  std::vector<Wall> lines_;
  std::vector<Circle> circles_;
};

}  // namespace evigrid::raycast::testing
