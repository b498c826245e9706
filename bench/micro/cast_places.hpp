// SPDX-License-Identifier: Apache-2.0
// The worlds that casting is timed in, and the bare Embree loop over the same walls: rtcIntersect16 on quads, coherent,
// directions ready-made, no materials, no movers, no double precision.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <xmmintrin.h>

#include "evigrid/raycast/noise.hpp"
#include "evigrid/raycast/scene.hpp"
#include "evigrid/scenes/building.hpp"
#include "evigrid/scenes/scene.hpp"

namespace evigrid::bench {

using raycast::Point;

class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(raycast::random_bits({seed_, 0, 0, count_++}, 0) >> 11);
  }

 private:
  std::uint64_t seed_, count_ = 0;
};

inline constexpr int kPlaces = 6;

/// A world, where sensors stand in it, and who moves in it.
struct Place {
  const char* name;
  raycast::World world;
  std::vector<raycast::World> movers;
  std::vector<raycast::Placement> placements;
  Point low, high;
  double range_m;
};

inline Place room() {
  const scenes::Scene scene = scenes::parse_scene(scenes::default_scene_text(), "default");
  return {"default room", scene.world, {}, {}, {0.5, 0.5}, {9.5, 9.5}, 8};
}

inline Place segments() {
  Random r(1);
  Place p{"20 000 segments", {}, {}, {}, {1, 1}, {99, 99}, 8};
  for (int i = 0; i < 20000; ++i) {
    const Point from{r.uniform(0, 100), r.uniform(0, 100)};
    const double angle = r.uniform(0, 2 * std::numbers::pi), size = r.uniform(0.1, 1);
    p.world.walls.push_back({from, {from.x_m + size * std::cos(angle), from.y_m + size * std::sin(angle)}, {}});
  }
  return p;
}

/// Square rooms of 5 m with a door in each wall and 1.4 boxes each, for `side` × `side` of them: 10 give 960 segments.
inline Place rooms(const char* name, int side) {
  Random r(5);
  constexpr double kRoom_m = 5, kDoor_m = 1;
  const double extent = side * kRoom_m;
  Place p{name, {}, {}, {}, {2, 2}, {extent - 2, extent - 2}, 8};
  const auto wall = [&](double x0, double y0, double x1, double y1) {
    p.world.walls.push_back({{x0, y0}, {x1, y1}, {}});
  };
  for (int i = 0; i <= side; ++i)
    for (int j = 0; j < side; ++j) {
      const double at = i * kRoom_m, from = j * kRoom_m, to = from + kRoom_m;
      if (i == 0 || i == side) {
        wall(at, from, at, to);
        wall(from, at, to, at);
        continue;
      }
      double door = from + r.uniform(1, 3.5);
      wall(at, from, at, door), wall(at, door + kDoor_m, at, to);
      door = from + r.uniform(1, 3.5);
      wall(from, at, door, at), wall(door + kDoor_m, at, to, at);
    }
  for (int i = 0; i < side * side * 14 / 10; ++i)
    p.world.boxes.push_back(
        {{r.uniform(0, extent), r.uniform(0, extent)}, r.uniform(0.3, 1), r.uniform(0.3, 1), r.uniform(0, 3), {}});
  return p;
}

/// As the fleet of a big house meets it: corridors, doors, furniture with materials.
inline Place building() {
  return {"generated building", scenes::make_building({.width_m = 120, .depth_m = 80}), {}, {}, {1, 1}, {119, 79}, 8};
}

inline Place fleet() {
  Random r(2);
  Place p = room();
  p.name = "default room, 50 movers";
  for (int i = 0; i < 50; ++i) {
    p.movers.push_back({.circles = {{{0, 0}, 0.2, {}}}});
    p.placements.push_back({r.uniform(0.5, 9.5), r.uniform(0.5, 9.5), r.uniform(-3, 3)});
  }
  return p;
}

inline const Place& place(int which) {
  static const Place places[kPlaces] = {
      room(), segments(), fleet(), rooms("960 segments", 10), rooms("96 000 segments", 100), building()};
  return places[which];
}
inline const raycast::Scene& scene(int which, raycast::Index index) {
  static std::unique_ptr<raycast::Scene> scenes[kPlaces][3];
  auto& s = scenes[which][static_cast<int>(index)];
  if (!s) s = std::make_unique<raycast::Scene>(place(which).world, place(which).movers, index);
  return *s;
}

/// All straight walls; circles as regular polygons of 32 sides.
inline std::vector<std::pair<Point, Point>> lines_of(const Place& p) {
  std::vector<std::pair<Point, Point>> lines;
  const auto closed = [&](const std::vector<Point>& v) {
    for (std::size_t i = 0; i < v.size(); ++i) lines.emplace_back(v[i], v[(i + 1) % v.size()]);
  };
  const auto add = [&](const raycast::World& w, const raycast::Placement& at) {
    for (const auto& wall : w.walls) lines.emplace_back(wall.from, wall.to);
    for (const auto& polygon : w.polygons) closed(polygon.vertices);
    for (const auto& box : w.boxes) {
      const double c = std::cos(box.yaw_rad) / 2, s = std::sin(box.yaw_rad) / 2, l = box.length_m, h = box.width_m;
      const Point m = box.centre;
      closed({{m.x_m - c * l + s * h, m.y_m - s * l - c * h},
              {m.x_m + c * l + s * h, m.y_m + s * l - c * h},
              {m.x_m + c * l - s * h, m.y_m + s * l + c * h},
              {m.x_m - c * l - s * h, m.y_m - s * l + c * h}});
    }
    for (const auto& circle : w.circles) {
      std::vector<Point> v;
      for (int i = 0; i < 32; ++i)
        v.push_back({at.x_m + circle.centre.x_m + circle.radius_m * std::cos(i * std::numbers::pi / 16),
                     at.y_m + circle.centre.y_m + circle.radius_m * std::sin(i * std::numbers::pi / 16)});
      closed(v);
    }
  };
  add(p.world, {});
  for (std::size_t i = 0; i < p.movers.size(); ++i) add(p.movers[i], p.placements[i]);
  return lines;
}

/// They as quads two metres high.
struct Quads {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);

  explicit Quads(const Place& p) {
    const std::vector<std::pair<Point, Point>> lines = lines_of(p);
    RTCGeometry quads = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(quads, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                          3 * sizeof(float), 4 * lines.size()));
    auto* index = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(quads, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), lines.size()));
    for (const auto& [from, to] : lines)
      for (const auto& [point, z] : {std::pair(from, -1.0f), {to, -1.0f}, {to, 1.0f}, {from, 1.0f}}) {
        *v++ = static_cast<float>(point.x_m);
        *v++ = static_cast<float>(point.y_m);
        *v++ = z;
      }
    for (unsigned i = 0; i < 4 * lines.size(); ++i) index[i] = i;
    rtcSetGeometryMask(quads, 0xffffffffu);
    rtcCommitGeometry(quads);
    rtcAttachGeometry(scene, quads);
    rtcReleaseGeometry(quads);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene);
  }
};

inline const Quads& quads(int which) {
  static std::unique_ptr<const Quads> all[kPlaces];
  if (!all[which]) all[which] = std::make_unique<const Quads>(place(which));
  return *all[which];
}

/// One ray per entry, in packets of 16; `ranges_m` gets what they meet.
struct Bundle {
  std::vector<float> x, y, dx, dy;
  void add(double px, double py, double angle) {
    x.push_back(static_cast<float>(px));
    y.push_back(static_cast<float>(py));
    dx.push_back(static_cast<float>(std::cos(angle)));
    dy.push_back(static_cast<float>(std::sin(angle)));
  }
};

/// Rays from, …, to − 1; both are multiples of 16.
inline void bare(RTCScene scene, const Bundle& b, std::size_t from, std::size_t to, float range_m, float* ranges_m) {
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
#endif
  alignas(64) int valid[16];
  std::fill_n(valid, 16, -1);
  RTCRayHit16 packet;
  for (std::size_t i = from; i < to; i += 16) {
    for (std::size_t k = 0; k < 16; ++k) {
      packet.ray.org_x[k] = b.x[i + k];
      packet.ray.org_y[k] = b.y[i + k];
      packet.ray.org_z[k] = 0;
      packet.ray.dir_x[k] = b.dx[i + k];
      packet.ray.dir_y[k] = b.dy[i + k];
      packet.ray.dir_z[k] = 0;
      packet.ray.tnear[k] = 0;
      packet.ray.tfar[k] = range_m;
      packet.ray.time[k] = 0;
      packet.ray.mask[k] = 0xffffffffu;
      packet.ray.flags[k] = 0;
      packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect16(valid, scene, &packet, &arguments);
#else
    rtcIntersect16(valid, scene, &context, &packet);
#endif
    for (std::size_t k = 0; k < 16; ++k) ranges_m[i + k] = packet.ray.tfar[k];
  }
}

}  // namespace evigrid::bench
