// SPDX-License-Identifier: Apache-2.0
// Recorded buildings, whole: every scan of a log fused into an empty map, in batches as the driver hands them over.
// Manual time is integration alone (the report's fusion_s). items = cell updates. Skips by name where a log is absent.
#include <benchmark/benchmark.h>

#include <chrono>
#include <filesystem>
#include <limits>

#include "evigrid/evigrid.hpp"
#include "log/readers.hpp"

namespace {

using namespace evigrid;

void building(benchmark::State& state, const char* file, Rule rule, Kernel kernel, double max_range_m) {
  const std::string path = std::string(EVIGRID_DATA_DIR "/laser/ple-radish-corrected/") + file;
  if (!std::filesystem::exists(path)) return state.SkipWithError(("missing: " + path).c_str());
  if (!kernel_available(kernel)) return state.SkipWithError("this processor cannot run the kernel");
  static std::map<std::string, driver::Log> logs;
  if (!logs.contains(path)) logs[path] = driver::read_log({path}, "carmen");
  const driver::Log& log = logs[path];
  const int threads = static_cast<int>(state.range(0));
  const std::shared_ptr<Executor> executor =
      threads == 1 ? std::shared_ptr<Executor>(make_serial_executor()) : make_tbb_executor(threads);
  std::uint64_t cells = 0;
  for (auto _ : state) {
    Map map({.cell_m = 0.05, .rule = rule, .kernel = kernel}, executor);
    std::vector<SensorId> ids;
    for (const driver::LogSensor& s : log.sensors) {
      Sensor sensor = s.sensor;
      sensor.max_range_m = std::min(max_range_m, sensor.no_return_m);
      ids.push_back(map.add(sensor));
    }
    std::vector<Reading> readings;
    for (const auto& r : log.readings)
      readings.push_back({ids[r.sensor], std::span(log.ranges_m).subspan(r.first, r.count)});
    std::vector<Scan> scans;
    for (const auto& s : log.scans)
      scans.push_back({s.stamp_ns, s.T_map_robot, std::span<const Reading>(readings).subspan(s.first, s.count)});
    const auto start = std::chrono::steady_clock::now();
    constexpr std::size_t kBatch = 128;
    for (std::size_t at = 0; at < scans.size(); at += kBatch) {
      cells += map.integrate(std::span<const Scan>(scans).subspan(at, std::min(kBatch, scans.size() - at)))
                   .cells_updated;
    }
    state.SetIterationTime(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    benchmark::DoNotOptimize(map.tiles());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(cells));
}
#define EVIGRID_BUILDING(label, file, kernel, range)                                           \
  BENCHMARK_CAPTURE(building, label##_pcr5_##kernel, file, Rule::pcr5, Kernel::kernel, range) \
      ->Arg(1)                                                                                 \
      ->Arg(2)                                                                                 \
      ->UseManualTime()                                                                        \
      ->Unit(benchmark::kMillisecond)
EVIGRID_BUILDING(intel, "intel-corrected.log.gz", avx512, 10);
EVIGRID_BUILDING(intel, "intel-corrected.log.gz", avx2, 10);
EVIGRID_BUILDING(freiburg079, "freiburg-079-corrected.log.gz", avx512, std::numeric_limits<double>::max());

}  // namespace
