// SPDX-License-Identifier: Apache-2.0
// Casting: cones and laser rays, in three worlds, beside a bare Embree loop over the same walls in the same binary and
// run: rtcIntersect16 on quads, coherent, directions ready-made, no materials, no movers, no double precision. items =
// cones or rays. Compare within one run only.
// Usage: bench_cast --benchmark_enable_random_interleaving=true --benchmark_repetitions=9
// --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <xmmintrin.h>

#include "evigrid/raycast/noise.hpp"
#include "evigrid/raycast/scene.hpp"
#include "evigrid/scenes/scene.hpp"

namespace {

using namespace evigrid;
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

/// A world, where sensors stand in it, and who moves in it.
struct Place {
  raycast::World world;
  std::vector<raycast::World> movers;
  std::vector<raycast::Placement> placements;
  Point low, high;
  double range_m;
};

Place room() {
  const scenes::Scene scene = scenes::parse_scene(scenes::default_scene_text(), "default");
  return {scene.world, {}, {}, {0.5, 0.5}, {9.5, 9.5}, 8};
}

Place segments() {
  Random r(1);
  Place p{{}, {}, {}, {1, 1}, {99, 99}, 8};
  for (int i = 0; i < 20000; ++i) {
    const Point from{r.uniform(0, 100), r.uniform(0, 100)};
    const double angle = r.uniform(0, 2 * std::numbers::pi), size = r.uniform(0.1, 1);
    p.world.walls.push_back({from, {from.x_m + size * std::cos(angle), from.y_m + size * std::sin(angle)}, {}});
  }
  return p;
}

Place fleet() {
  Random r(2);
  Place p = room();
  for (int i = 0; i < 50; ++i) {
    p.movers.push_back({.circles = {{{0, 0}, 0.2, {}}}});
    p.placements.push_back({r.uniform(0.5, 9.5), r.uniform(0.5, 9.5), r.uniform(-3, 3)});
  }
  return p;
}

const Place& place(int which) {
  static const Place places[3] = {room(), segments(), fleet()};
  return places[which];
}
const raycast::Scene& scene(int which) {
  static const auto make = [](int i) { return raycast::Scene(place(i).world, place(i).movers); };
  static const raycast::Scene scenes[3] = {make(0), make(1), make(2)};
  return scenes[which];
}
const char* const kNames[3] = {"default room", "20 000 segments", "default room, 50 movers"};

constexpr int kPoses = 512, kBeams = 360, kRaysPerCone = 64;

std::vector<raycast::ConeQuery> cones(const Place& p) {
  Random r(3);
  std::vector<raycast::ConeQuery> all;
  for (int i = 0; i < kPoses * 24; ++i)
    all.push_back({r.uniform(p.low.x_m, p.high.x_m), r.uniform(p.low.y_m, p.high.y_m), r.uniform(-3, 3),
                   30 * std::numbers::pi / 180, 0.1, 4});
  return all;
}
std::vector<raycast::FanQuery> fans(const Place& p) {
  Random r(4);
  std::vector<raycast::FanQuery> all;
  for (int i = 0; i < kPoses; ++i)
    all.push_back({r.uniform(p.low.x_m, p.high.x_m), r.uniform(p.low.y_m, p.high.y_m), r.uniform(-3, 3), 0,
                   2 * std::numbers::pi / kBeams, kBeams, p.range_m});
  return all;
}

void cast_cones(benchmark::State& state) {
  const int which = static_cast<int>(state.range(0)), threads = static_cast<int>(state.range(1));
  const auto queries = cones(place(which));
  std::vector<raycast::Echo> echoes(queries.size());
  for (auto _ : state) scene(which).cast_cones(queries, echoes, place(which).placements, threads);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(queries.size()));
  state.SetLabel(kNames[which]);
}

void second_bounces(benchmark::State& state) {
  const int which = static_cast<int>(state.range(0));
  const auto queries = cones(place(which));
  for (auto _ : state)
    for (const auto& q : queries)
      benchmark::DoNotOptimize(scene(which).cast_cone_second_bounce(q, place(which).placements));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(queries.size()));
  state.SetLabel(kNames[which]);
}

/// Neighbours of a ring of 24.
void cross_talk(benchmark::State& state) {
  const int which = static_cast<int>(state.range(0));
  const auto queries = cones(place(which));
  for (auto _ : state)
    for (raycast::ConeQuery q : queries) {
      raycast::ConeQuery speaker = q;
      speaker.yaw_rad += 15 * std::numbers::pi / 180;
      speaker.x_m += 0.05;
      benchmark::DoNotOptimize(scene(which).cross_talk(speaker, q, place(which).placements));
    }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(queries.size()));
  state.SetLabel(kNames[which]);
}

void single_rays(benchmark::State& state) {
  const int which = static_cast<int>(state.range(0));
  const auto queries = fans(place(which));
  for (auto _ : state)
    for (const auto& q : queries)
      for (int i = 0; i < q.beams; ++i)
        benchmark::DoNotOptimize(scene(which).ray_range(q.x_m, q.y_m, q.yaw_rad + q.first_rad + i * q.step_rad,
                                                        q.max_range_m, place(which).placements));
  state.SetItemsProcessed(state.iterations() * kPoses * kBeams);
  state.SetLabel(kNames[which]);
}

void fan_rays(benchmark::State& state) {
  const int which = static_cast<int>(state.range(0)), threads = static_cast<int>(state.range(1));
  const auto queries = fans(place(which));
  std::vector<double> ranges_m(kPoses * kBeams);
  for (auto _ : state) scene(which).cast_fans(queries, ranges_m, place(which).placements, threads);
  state.SetItemsProcessed(state.iterations() * kPoses * kBeams);
  state.SetLabel(kNames[which]);
}

// --- the bare loop ---------------------------------------------------------------------------------------------------

/// All straight walls as quads two metres high; circles as regular polygons of 32 sides.
struct Quads {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);

  explicit Quads(const Place& p) {
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

const Quads& quads(int which) {
  static const Quads all[3] = {Quads(place(0)), Quads(place(1)), Quads(place(2))};
  return all[which];
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

void bare(RTCScene scene, const Bundle& b, float range_m, float* ranges_m) {
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
  for (std::size_t i = 0; i < b.x.size(); i += 16) {
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

void bare_embree_fan_rays(benchmark::State& state) {
  const int which = static_cast<int>(state.range(0));
  Bundle rays;
  for (const auto& q : fans(place(which)))
    for (int i = 0; i < (q.beams + 15) / 16 * 16; ++i)
      rays.add(q.x_m, q.y_m, q.yaw_rad + std::min(i, q.beams - 1) * q.step_rad);
  std::vector<float> ranges_m(rays.x.size());
  const unsigned modes = _mm_getcsr();
  _mm_setcsr(modes | 0x8040u);
  for (auto _ : state) {
    bare(quads(which).scene, rays, static_cast<float>(place(which).range_m), ranges_m.data());
    benchmark::ClobberMemory();
  }
  _mm_setcsr(modes);
  state.SetItemsProcessed(state.iterations() * kPoses * kBeams);
  state.SetLabel(kNames[which]);
}

/// The naive sonar: the minimum of 64 rays.
void bare_embree_64_ray_cones(benchmark::State& state) {
  const int which = static_cast<int>(state.range(0));
  const auto queries = cones(place(which));
  Bundle rays;
  for (const auto& q : queries)
    for (int i = 0; i < kRaysPerCone; ++i)
      rays.add(q.x_m, q.y_m, q.yaw_rad + q.aperture_rad * (i / (kRaysPerCone - 1.0) - 0.5));
  std::vector<float> ranges_m(rays.x.size()), nearest_m(queries.size());
  const unsigned modes = _mm_getcsr();
  _mm_setcsr(modes | 0x8040u);
  for (auto _ : state) {
    bare(quads(which).scene, rays, 4, ranges_m.data());
    for (std::size_t i = 0; i < queries.size(); ++i)
      nearest_m[i] = *std::min_element(ranges_m.begin() + static_cast<std::ptrdiff_t>(i * kRaysPerCone),
                                       ranges_m.begin() + static_cast<std::ptrdiff_t>((i + 1) * kRaysPerCone));
    benchmark::ClobberMemory();
  }
  _mm_setcsr(modes);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(queries.size()));
  state.SetLabel(kNames[which]);
}

void places(benchmark::internal::Benchmark* b) { b->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond); }
/// One thread by the time of the processor, which a busy machine does not spoil; two by the clock.
void one_thread(benchmark::internal::Benchmark* b) {
  b->Args({0, 1})->Args({1, 1})->Args({2, 1})->Unit(benchmark::kMillisecond);
}
void two_threads(benchmark::internal::Benchmark* b) {
  b->Args({0, 2})->Args({1, 2})->Args({2, 2})->UseRealTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK(cast_cones)->Apply(one_thread);
BENCHMARK(cast_cones)->Apply(two_threads);
BENCHMARK(bare_embree_64_ray_cones)->Apply(places);
BENCHMARK(fan_rays)->Apply(one_thread);
BENCHMARK(fan_rays)->Apply(two_threads);
BENCHMARK(bare_embree_fan_rays)->Apply(places);
BENCHMARK(single_rays)->Apply(places);
BENCHMARK(second_bounces)->Apply(places);
BENCHMARK(cross_talk)->Apply(places);

}  // namespace
