// SPDX-License-Identifier: Apache-2.0
// Buildings, whole: every scan of a log fused into an empty map, in batches as the driver hands them over. Manual time
// is integration alone (the report's fusion_s). items = cell updates. Recorded logs skip by name where they are absent;
// `generated` needs none: a building from a seed, a laser's tour through it. `both` is the Intel log and freiburg-079,
// one after the other.
#include <benchmark/benchmark.h>

#include <chrono>
#include <filesystem>
#include <limits>
#include <map>

#include "evigrid/evigrid.hpp"
#include "log/readers.hpp"
#include "world_input.hpp"

namespace {

using namespace evigrid;

constexpr double kFar = std::numeric_limits<double>::max();

struct Building {
  const char* file;    // nullptr: generated
  double max_range_m;  // of a recorded one
};

/// nullptr when the recorded log is absent.
const driver::Log* log_of(const Building& b) {
  static std::map<std::string, driver::Log> logs;
  const std::string key = b.file != nullptr ? b.file : "generated";
  if (const auto known = logs.find(key); known != logs.end()) return &known->second;
  if (b.file == nullptr) {
    driver::WorldOptions world;
    world.world = "building";
    world.robot = "laser180";
    world.seed = 3;
    return &(logs[key] = driver::simulate(driver::open_input(world).scene, {.threads = 2}).log);
  }
  const std::string path = EVIGRID_DATA_DIR "/laser/ple-radish-corrected/" + key + "-corrected.log.gz";
  if (!std::filesystem::exists(path)) return nullptr;
  return &(logs[key] = driver::read_log({path}, "carmen"));
}

struct Fused {
  double seconds;
  std::uint64_t cells;
};

Fused fuse(const Building& b, Rule rule, Kernel kernel, const std::shared_ptr<Executor>& executor) {
  const driver::Log& log = *log_of(b);
  Map map({.cell_m = 0.05, .rule = rule, .kernel = kernel}, executor);
  std::vector<SensorId> ids;
  for (const driver::LogSensor& s : log.sensors) {
    Sensor sensor = s.sensor;
    if (b.file != nullptr) sensor.max_range_m = std::min(b.max_range_m, sensor.no_return_m);
    ids.push_back(map.add(sensor));
  }
  std::vector<Reading> readings;
  for (const auto& r : log.readings)
    readings.push_back({ids[r.sensor], std::span(log.ranges_m).subspan(r.first, r.count)});
  std::vector<Scan> scans;
  for (const auto& s : log.scans)
    scans.push_back({s.stamp_ns, s.T_map_robot, std::span<const Reading>(readings).subspan(s.first, s.count)});
  constexpr std::size_t kBatch = 128;
  Fused f{0, 0};
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t at = 0; at < scans.size(); at += kBatch) {
    const auto batch = std::span<const Scan>(scans).subspan(at, std::min(kBatch, scans.size() - at));
    f.cells += map.integrate(batch).cells_updated;
  }
  f.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  benchmark::DoNotOptimize(map.tiles());
  return f;
}

void building(benchmark::State& state, const std::vector<Building>& buildings, Rule rule, Kernel kernel) {
  if (!kernel_available(kernel)) return state.SkipWithError("this processor cannot run the kernel");
  for (const Building& b : buildings) {
    if (log_of(b) == nullptr) return state.SkipWithError((std::string("missing log: ") + b.file).c_str());
  }
  const int threads = static_cast<int>(state.range(0));
  const std::shared_ptr<Executor> executor =
      threads == 1 ? std::shared_ptr<Executor>(make_serial_executor()) : make_tbb_executor(threads);
  std::uint64_t cells = 0;
  for (auto _ : state) {
    double seconds = 0;
    for (const Building& b : buildings) {
      const Fused f = fuse(b, rule, kernel, executor);
      seconds += f.seconds;
      cells += f.cells;
    }
    state.SetIterationTime(seconds);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(cells));
}

const Building kIntel{"intel", 10}, kFreiburg{"freiburg-079", kFar}, kAces{"aces", kFar}, kSeattle{"seattle", kFar},
    kOrebro{"orebro", kFar}, kGenerated{nullptr, kFar};

#define EVIGRID_BUILDING(label, kernel, ...)                                                                         \
  BENCHMARK_CAPTURE(building, label##_pcr5_##kernel, std::vector<Building>{__VA_ARGS__}, Rule::pcr5, Kernel::kernel) \
      ->Arg(1)                                                                                                       \
      ->Arg(2)                                                                                                       \
      ->UseManualTime()                                                                                              \
      ->Unit(benchmark::kMillisecond)
EVIGRID_BUILDING(intel, avx512, kIntel);
EVIGRID_BUILDING(intel, avx2, kIntel);
EVIGRID_BUILDING(freiburg079, avx512, kFreiburg);
EVIGRID_BUILDING(freiburg079, avx2, kFreiburg);
EVIGRID_BUILDING(both, avx512, kIntel, kFreiburg);
EVIGRID_BUILDING(aces, avx512, kAces);
EVIGRID_BUILDING(seattle, avx512, kSeattle);
EVIGRID_BUILDING(orebro, avx512, kOrebro);
EVIGRID_BUILDING(generated, avx512, kGenerated);

}  // namespace
