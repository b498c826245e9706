// SPDX-License-Identifier: Apache-2.0
// What the time of one scan of sonars depends on, and what it does not: the extent of the map, the number of sensors,
// threads from how many cones on, forgetting, a learned revision, and what readings of one scan are to one another.
// li2014 + PCR5, warm.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>
#include <vector>

#include "evigrid/evigrid.hpp"

namespace {

using namespace evigrid;

/// Rings of sonars of 15° at one place, turned against each other, and their readings.
struct Ring {
  Map map;
  std::vector<float> ranges;
  std::vector<Reading> readings;

  Ring(const MapParams& params, int sonars, std::unique_ptr<Executor> executor,
       Dependence dependence = Dependence::independent, std::shared_ptr<const RevisionNetwork> revision = nullptr)
      : map(params, std::move(executor)), ranges(static_cast<std::size_t>(sonars)) {
    for (int i = 0; i < sonars; ++i) {
      Sensor s;
      s.aperture_rad = 15 * M_PI / 180;
      s.dependence = dependence;
      if (dependence == Dependence::weighted) s.weight_exponent = 0.5;
      s.revision = revision;
      const double yaw = i * 2 * M_PI / sonars;
      s.T_robot_sensor = {0.2 * std::cos(yaw), 0.2 * std::sin(yaw), yaw};
      readings.push_back({map.add(s), {&ranges[static_cast<std::size_t>(i)], 1}});
    }
  }
  std::uint64_t scan(int step) {
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      ranges[i] = 1 + 0.1f * static_cast<float>((static_cast<int>(i) * 37 + step * 11) % 35);
    }
    const Pose2 at{0.01 * (step % 500), 0.007 * (step % 300), 0.1 * step};
    return map.integrate(Scan{step * 100'000'000LL, at, readings}).cells_updated;
  }
  void run(benchmark::State& state) {
    std::uint64_t cells = 0;
    int step = 0;
    for (; step < 600; ++step) scan(step);  // every place was there once
    for (auto _ : state) cells += scan(step++);
    const double scans = static_cast<double>(state.iterations());
    state.SetItemsProcessed(static_cast<std::int64_t>(cells));
    state.counters["cells_a_scan"] = static_cast<double>(cells) / scans;
    state.counters["readings"] = static_cast<double>(readings.size());
  }
};

/// Cells known at every 1024th place of both diagonals of a square of that side: the map is that large.
void side(benchmark::State& state) {
  Ring ring({}, 24, make_serial_executor());
  const std::int64_t half = state.range(0) / 2;
  const std::vector<Mass> wall{{0, 0.9f, 0.1f}};
  for (std::int64_t d = -half; d < half; d += half < 1024 ? 64 : 1024) {
    ring.map.write({d, d, 1, 1}, wall, 1);
    ring.map.write({d, -d - 1, 1, 1}, wall, 1);
  }
  ring.run(state);
  state.counters["tiles"] = static_cast<double>(ring.map.tiles());
}
BENCHMARK(side)->ArgName("cells")->Arg(256)->Arg(4096)->Arg(16384)->Arg(65536)->Arg(1 << 20);

void sensors(benchmark::State& state) { Ring({}, static_cast<int>(state.range(0)), make_serial_executor()).run(state); }
BENCHMARK(sensors)->ArgName("n")->Arg(1)->Arg(2)->Arg(4)->Arg(8)->Arg(16)->Arg(24)->Arg(48)->Arg(96);

void threads(benchmark::State& state, const char* executor) {
  Ring({}, static_cast<int>(state.range(0)), make_executor(executor, static_cast<int>(state.range(1)))).run(state);
}
void cones_and_threads(benchmark::internal::Benchmark* b) {
  b->ArgNames({"cones", "threads"})->UseRealTime();
  for (const int cones : {8, 24, 96}) b->Args({cones, 1})->Args({cones, 2});
}
BENCHMARK_CAPTURE(threads, tbb, "tbb")->Apply(cones_and_threads);
BENCHMARK_CAPTURE(threads, spin, "spin")->Apply(cones_and_threads);

void dependence(benchmark::State& state, Dependence how) { Ring({}, 24, make_serial_executor(), how).run(state); }
BENCHMARK_CAPTURE(dependence, independent, Dependence::independent);
BENCHMARK_CAPTURE(dependence, cautious, Dependence::cautious);
BENCHMARK_CAPTURE(dependence, once_per_scan, Dependence::once_per_scan);
BENCHMARK_CAPTURE(dependence, weighted, Dependence::weighted);

void revised(benchmark::State& state) {
  auto network = std::make_shared<RevisionNetwork>();
  for (std::size_t i = 0; i < network->weight.size(); ++i) {
    network->weight[i] = 3 * std::sin(1 + 7.3 * static_cast<double>(i));
  }
  Ring({}, 24, make_serial_executor(), Dependence::independent, network).run(state);
}
BENCHMARK(revised);

void forgetting(benchmark::State& state) {
  Ring({.decay_s = static_cast<double>(state.range(0))}, 24, make_serial_executor()).run(state);
}
BENCHMARK(forgetting)->ArgName("decay_s")->Arg(0)->Arg(60);

}  // namespace
