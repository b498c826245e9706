// SPDX-License-Identifier: Apache-2.0
// Casting: cones and laser rays, beside a bare Embree loop over the same walls in the same binary and run
// (cast_places.hpp). `cones` runs the bare loop of 64 rays a cone, Embree's point query and the bucket grid in turn in
// every iteration and reports the medians of their ratios, so that load of the machine falls on all three alike.
// items = cones or rays. Compare within one run only.
// Usage: bench_cast --benchmark_filter=cones --benchmark_min_time=0.3
//        bench_cast --benchmark_filter=fan --benchmark_enable_random_interleaving=true --benchmark_repetitions=9
//        --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "cast_places.hpp"
#include "evigrid/raycast/scene.hpp"

namespace {

using namespace evigrid;
using namespace evigrid::bench;
using raycast::Index;

constexpr int kPoses = 512, kBeams = 360, kRaysPerCone = 64;
constexpr double kRange_m = 5;

/// `ring`: 24 to a pose, 0.2 m around it; otherwise each at a place of its own.
std::vector<raycast::ConeQuery> queries_in(const Place& p, double aperture_deg, bool ring) {
  Random r(3);
  std::vector<raycast::ConeQuery> all;
  double x = 0, y = 0, yaw = 0;
  for (int i = 0; i < kPoses * 24; ++i) {
    if (!ring || i % 24 == 0)
      x = r.uniform(p.low.x_m, p.high.x_m), y = r.uniform(p.low.y_m, p.high.y_m), yaw = r.uniform(-3, 3);
    const double bearing = yaw + (i % 24) * std::numbers::pi / 12, radius = ring ? 0.2 : 0;
    all.push_back({x + radius * std::cos(bearing), y + radius * std::sin(bearing), bearing,
                   aperture_deg * std::numbers::pi / 180, 0.1, kRange_m});
  }
  return all;
}
std::vector<raycast::ConeQuery> random_cones(const Place& p) { return queries_in(p, 30, false); }
std::vector<raycast::FanQuery> fans(const Place& p) {
  Random r(4);
  std::vector<raycast::FanQuery> all;
  for (int i = 0; i < kPoses; ++i)
    all.push_back({r.uniform(p.low.x_m, p.high.x_m), r.uniform(p.low.y_m, p.high.y_m), r.uniform(-3, 3), 0,
                   2 * std::numbers::pi / kBeams, kBeams, p.range_m});
  return all;
}

/// Calls work(from, to) for the cones from, …, to − 1, in one part for each thread.
template <typename Work>
void in_parts(std::size_t count, int threads, const Work& work) {
  const auto part = [&](std::size_t t) {
    const auto n = static_cast<std::size_t>(threads);
    work(count * t / n, count * (t + 1) / n);
  };
  if (threads == 1) return part(0);
  static tbb::task_arena arena(2);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(threads), part); });
}

template <typename Work>
double seconds(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

/// Time and rates are those of the buckets; query_x and buckets_x: how often as many cones as by the least of 64 rays.
void cones(benchmark::State& state) {
  const int which = static_cast<int>(state.range(0)), threads = static_cast<int>(state.range(3));
  const Place& p = place(which);
  const auto queries = queries_in(p, static_cast<double>(state.range(1)), state.range(2) != 0);
  Bundle rays;
  for (const auto& q : queries)
    for (int i = 0; i < kRaysPerCone; ++i)
      rays.add(q.x_m, q.y_m, q.yaw_rad + q.aperture_rad * (i / (kRaysPerCone - 1.0) - 0.5));
  std::vector<float> ranges_m(rays.x.size()), nearest_m(queries.size());
  std::vector<raycast::Echo> by_query(queries.size()), by_buckets(queries.size());
  const RTCScene bare_scene = quads(which).scene;
  const auto least_of_rays = [&](std::size_t from, std::size_t to) {
    const unsigned modes = _mm_getcsr();
    _mm_setcsr(modes | 0x8040u);
    bare(bare_scene, rays, from * kRaysPerCone, to * kRaysPerCone, kRange_m, ranges_m.data());
    for (std::size_t i = from; i < to; ++i)
      nearest_m[i] = *std::min_element(ranges_m.begin() + static_cast<std::ptrdiff_t>(i * kRaysPerCone),
                                       ranges_m.begin() + static_cast<std::ptrdiff_t>((i + 1) * kRaysPerCone));
    _mm_setcsr(modes);
  };
  const raycast::Scene &query = scene(which, Index::embree), &buckets = scene(which, Index::buckets);
  std::vector<double> rays_s, query_x, buckets_x;
  for (auto _ : state) {
    const double r = seconds([&] { in_parts(queries.size(), threads, least_of_rays); });
    const double e = seconds([&] { query.cast_cones(queries, by_query, p.placements, threads); });
    const double b = seconds([&] { buckets.cast_cones(queries, by_buckets, p.placements, threads); });
    state.SetIterationTime(b);
    rays_s.push_back(r), query_x.push_back(r / e), buckets_x.push_back(r / b);
    benchmark::ClobberMemory();
  }
  for (std::size_t i = 0; i < queries.size(); ++i)
    if (by_query[i].status != by_buckets[i].status || by_query[i].range_m != by_buckets[i].range_m)
      return state.SkipWithError("the indices differ");
  const auto count = static_cast<double>(queries.size());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(queries.size()));
  state.counters["rays64"] = count / median(rays_s);
  state.counters["query_x"] = median(query_x);
  state.counters["buckets_x"] = median(buckets_x);
  state.SetLabel(p.name);
}

void second_bounces(benchmark::State& state) {
  const int which = static_cast<int>(state.range(0));
  const auto queries = random_cones(place(which));
  for (auto _ : state)
    for (const auto& q : queries)
      benchmark::DoNotOptimize(scene(which, Index::automatic).cast_cone_second_bounce(q, place(which).placements));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(queries.size()));
  state.SetLabel(place(which).name);
}

/// Neighbours of a ring of 24.
void cross_talk(benchmark::State& state) {
  const int which = static_cast<int>(state.range(0));
  const auto queries = random_cones(place(which));
  for (auto _ : state)
    for (raycast::ConeQuery q : queries) {
      raycast::ConeQuery speaker = q;
      speaker.yaw_rad += 15 * std::numbers::pi / 180;
      speaker.x_m += 0.05;
      benchmark::DoNotOptimize(scene(which, Index::automatic).cross_talk(speaker, q, place(which).placements));
    }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(queries.size()));
  state.SetLabel(place(which).name);
}

void single_rays(benchmark::State& state) {
  const int which = static_cast<int>(state.range(0));
  const auto queries = fans(place(which));
  for (auto _ : state)
    for (const auto& q : queries)
      for (int i = 0; i < q.beams; ++i)
        benchmark::DoNotOptimize(scene(which, Index::automatic)
                                     .ray_range(q.x_m, q.y_m, q.yaw_rad + q.first_rad + i * q.step_rad, q.max_range_m,
                                                place(which).placements));
  state.SetItemsProcessed(state.iterations() * kPoses * kBeams);
  state.SetLabel(place(which).name);
}

void fan_rays(benchmark::State& state) {
  const int which = static_cast<int>(state.range(0)), threads = static_cast<int>(state.range(1));
  const auto queries = fans(place(which));
  std::vector<double> ranges_m(kPoses * kBeams);
  for (auto _ : state) scene(which, Index::automatic).cast_fans(queries, ranges_m, place(which).placements, threads);
  state.SetItemsProcessed(state.iterations() * kPoses * kBeams);
  state.SetLabel(place(which).name);
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
    bare(quads(which).scene, rays, 0, rays.x.size(), static_cast<float>(place(which).range_m), ranges_m.data());
    benchmark::ClobberMemory();
  }
  _mm_setcsr(modes);
  state.SetItemsProcessed(state.iterations() * kPoses * kBeams);
  state.SetLabel(place(which).name);
}

void places(benchmark::internal::Benchmark* b) { b->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond); }
/// One thread by the time of the processor, which a busy machine does not spoil; two by the clock.
void one_thread(benchmark::internal::Benchmark* b) {
  b->Args({0, 1})->Args({1, 1})->Args({2, 1})->Unit(benchmark::kMillisecond);
}
void two_threads(benchmark::internal::Benchmark* b) {
  b->Args({0, 2})->Args({1, 2})->Args({2, 2})->UseRealTime()->Unit(benchmark::kMillisecond);
}
void all_cones(benchmark::internal::Benchmark* b) {
  b->ArgNames({"place", "aperture", "ring", "threads"})->Unit(benchmark::kMillisecond)->UseManualTime();
  for (int which = 0; which < kPlaces; ++which)
    for (int aperture : {15, 30})
      for (int threads : {1, 2}) b->Args({which, aperture, 1, threads});
  for (int which = 0; which < kPlaces; ++which) b->Args({which, 30, 0, 1});
}
BENCHMARK(cones)->Apply(all_cones);
BENCHMARK(fan_rays)->Apply(one_thread);
BENCHMARK(fan_rays)->Apply(two_threads);
BENCHMARK(bare_embree_fan_rays)->Apply(places);
BENCHMARK(single_rays)->Apply(places);
BENCHMARK(second_bounces)->Apply(places);
BENCHMARK(cross_talk)->Apply(places);

}  // namespace
