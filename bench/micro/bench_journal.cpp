// SPDX-License-Identifier: Apache-2.0
// The journal and what it makes possible. add: one record of 24 sonars or of a laser's 180 ranges, plain, through zstd,
// and with fsync after each; fuse beside it: what the same scan costs the map. read: all of it back. remove: a scan
// taken back out of a drive of 2000 sonar scans, the last one or one in the middle; rebuild: all poses changed, beside
// fusing the same scans once. Files go to the temporary folder.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <vector>

#include "evigrid/evigrid.hpp"

namespace {

using namespace evigrid;

struct Drive {
  std::vector<Sensor> sensors;
  std::vector<std::vector<float>> ranges;
  std::vector<std::vector<Reading>> readings;
  std::vector<Scan> scans;

  /// laser: one fan of 180 beams; else 24 sonars.
  Drive(bool laser, int n) {
    if (laser) {
      Sensor s;
      s.model = Model::beam;
      s.beams = 180;
      s.first_beam_rad = -M_PI / 2;
      s.beam_step_rad = M_PI / 180;
      s.max_range_m = 10;
      sensors.push_back(s);
    }
    for (int i = 0; !laser && i < 24; ++i) {
      Sensor s;
      s.aperture_rad = 30 * M_PI / 180;
      s.T_robot_sensor = {0.2 * std::cos(i * M_PI / 12), 0.2 * std::sin(i * M_PI / 12), i * M_PI / 12};
      sensors.push_back(s);
    }
    ranges.reserve(static_cast<std::size_t>(n) * sensors.size());
    for (int step = 0; step < n; ++step) {
      std::vector<Reading> all;
      for (std::size_t i = 0; i < sensors.size(); ++i) {
        std::vector<float> r;
        for (int b = 0; b < sensors[i].beams; ++b)
          r.push_back(1 + 0.013f * static_cast<float>((static_cast<int>(i) * 37 + b * 5 + step * 11) % 270));
        ranges.push_back(std::move(r));
        all.push_back({static_cast<SensorId>(i), ranges.back()});
      }
      readings.push_back(std::move(all));
      scans.push_back({step, {5 + 0.01 * step, 5 + 2 * std::sin(0.002 * step), 0.003 * step}, readings.back()});
    }
  }
  [[nodiscard]] Map map() const {
    Map out({.rule = Rule::pcr5}, make_serial_executor());
    for (const Sensor& s : sensors) out.add(s);
    return out;
  }
};

struct Scratch {
  std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("evigrid-bench-journal-" + std::to_string(::getpid()));
  Scratch() { remove(); }
  ~Scratch() { remove(); }
  void remove() const {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
  }
};

void add(benchmark::State& state, bool laser, JournalOptions options) {
  const Drive d(laser, 500);
  const Scratch to;
  std::optional<Journal> journal(Journal::create(to.file, {}, d.sensors, options));
  const std::uint64_t head = journal->bytes();
  std::size_t i = 0;
  for (auto _ : state) {
    journal->add(i + 1, d.scans[i % d.scans.size()]);
    ++i;
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(journal->bytes() - head));
  state.counters["bytes a record"] = static_cast<double>(journal->bytes() - head) / static_cast<double>(i);
}
BENCHMARK_CAPTURE(add, sonar24, false, {})->Iterations(20000);
BENCHMARK_CAPTURE(add, laser180, true, {})->Iterations(20000);
BENCHMARK_CAPTURE(add, laser180_zstd, true, {.compress = true})->Iterations(5000);
BENCHMARK_CAPTURE(add, laser180_fsync, true, {.sync_each = true})->Iterations(100)->UseRealTime();

void fuse(benchmark::State& state, bool laser) {
  const Drive d(laser, 500);
  Map map = d.map();
  std::size_t i = 0;
  for (auto _ : state) map.integrate(d.scans[i++ % d.scans.size()]);
}
BENCHMARK_CAPTURE(fuse, sonar24, false);
BENCHMARK_CAPTURE(fuse, laser180, true);

void read(benchmark::State& state) {
  const Drive d(true, 2000);
  const Scratch from;
  Journal journal = Journal::create(from.file, {}, d.sensors);
  for (std::size_t i = 0; i < d.scans.size(); ++i) journal.add(i + 1, d.scans[i]);
  for (auto _ : state) benchmark::DoNotOptimize(read_journal(from.file).events.size());
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * journal.bytes()));
}
BENCHMARK(read)->Unit(benchmark::kMillisecond);

void remembering(benchmark::State& state) {  // fuse, with the scans kept, the index and the checkpoints
  const Drive d(false, 2000);
  for (auto _ : state) {
    RevisableMap map(d.map());
    for (const Scan& s : d.scans) map.integrate(s);
    benchmark::DoNotOptimize(map.scans());
  }
}
BENCHMARK(remembering)->Unit(benchmark::kMillisecond);
void forgetting(benchmark::State& state) {  // fuse alone
  const Drive d(false, 2000);
  for (auto _ : state) {
    Map map = d.map();
    for (const Scan& s : d.scans) map.integrate(s);
    benchmark::DoNotOptimize(map.tiles());
  }
}
BENCHMARK(forgetting)->Unit(benchmark::kMillisecond);

void move(benchmark::State& state, double share) {  // of the drive, from its end
  const Drive d(false, 2000);
  RevisableMap map(d.map());
  map.integrate(d.scans);
  const ScanPose p = map.poses()[static_cast<std::size_t>(share * 1999)];
  RevisableMap::Revision cost;
  double by = 0.01;
  for (auto _ : state) {
    cost = map.move(p.id, {p.T_map_robot.x_m + by, p.T_map_robot.y_m, p.T_map_robot.yaw_rad});
    by = -by;
  }
  state.counters["scans"] = static_cast<double>(cost.scans);
  state.counters["tiles"] = static_cast<double>(cost.tiles);
}
BENCHMARK_CAPTURE(move, the_last, 1.0)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(move, in_the_middle, 0.5)->Unit(benchmark::kMicrosecond);

void rebuild(benchmark::State& state) {
  const Drive d(false, 2000);
  RevisableMap map(d.map());
  map.integrate(d.scans);
  std::vector<ScanPose> poses = map.poses();
  for (auto _ : state) {
    for (ScanPose& p : poses) p.T_map_robot.x_m += 0.01;
    map.rebuild(poses);
  }
}
BENCHMARK(rebuild)->Unit(benchmark::kMillisecond);

}  // namespace
