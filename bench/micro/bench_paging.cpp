// SPDX-License-Identifier: Apache-2.0
// What paging costs (Map::page_to): a robot that drives round and round over a map of which a share fits under the cap,
// and tiles going out and coming back as fast as they can.
#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <vector>

#include "evigrid/evigrid.hpp"

namespace {

using namespace evigrid;

constexpr std::size_t kTile = 64 * 64 * 4 * sizeof(float);

Map new_map(std::size_t tiles) {
  Map map({.rule = Rule::pcr5, .memory_cap_bytes = tiles * kTile}, make_serial_executor());
  map.page_to(std::filesystem::temp_directory_path());
  return map;
}

/// 24 sonars on a circle of 100 m, a metre a scan; percent: of the tiles that the round needs, how many fit.
void round_trip(benchmark::State& state) {
  constexpr int kSteps = 628;
  std::vector<Sensor> sensors(24);
  std::vector<float> ranges(24);
  std::vector<Reading> readings;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const double yaw = static_cast<double>(i) * 2 * M_PI / 24;
    sensors[i].aperture_rad = 15 * M_PI / 180;
    sensors[i].T_robot_sensor = {0.2 * std::cos(yaw), 0.2 * std::sin(yaw), yaw};
    readings.push_back({static_cast<SensorId>(i), {&ranges[i], 1}});
  }
  const auto scan = [&](Map& map, int step) {
    for (std::size_t i = 0; i < ranges.size(); ++i)
      ranges[i] = 1 + 0.1f * static_cast<float>((static_cast<int>(i) * 37 + step * 11) % 35);
    const double a = 2 * M_PI * (step % kSteps) / kSteps;
    map.integrate(Scan{step * 100'000'000LL, {100 * std::cos(a), 100 * std::sin(a), a}, readings});
  };
  const auto round = [&](Map& map) {
    for (const Sensor& s : sensors) map.add(s);
    for (int step = 0; step < kSteps; ++step) scan(map, step);
  };
  Map all = new_map(1 << 16);
  round(all);
  Map map = new_map(all.tiles() * static_cast<std::size_t>(state.range(0)) / 100);
  round(map);
  int step = 0;
  for (auto _ : state) scan(map, step++);
  state.counters["tiles"] = static_cast<double>(map.tiles());
  state.counters["in_memory"] = static_cast<double>(map.memory_bytes() / kTile);
}
BENCHMARK(round_trip)->ArgName("percent")->Arg(200)->Arg(50)->Arg(25)->Arg(10);

/// Two areas of 16 MB each by turns, where one fits: every write brings one back and puts the other out.
void out_and_in(benchmark::State& state) {
  constexpr int kSide = 16;
  Map map = new_map(kSide * kSide + 2);
  const std::vector<Mass> one{{0, 0.5f, 0.5f}};
  std::int64_t turn = 0;
  const auto touch = [&] {
    const std::int64_t at = turn++ % 2 * 100'000;
    for (std::int64_t y = 0; y < kSide; ++y) {
      for (std::int64_t x = 0; x < kSide; ++x) map.write({at + 64 * x, 64 * y, 1, 1}, one, 1);
    }
  };
  touch(), touch();
  for (auto _ : state) touch();
  state.SetBytesProcessed(state.iterations() * kSide * kSide * static_cast<std::int64_t>(kTile));
  state.counters["paged_tiles"] = static_cast<double>(map.paged_bytes() / kTile);
}
BENCHMARK(out_and_in)->Unit(benchmark::kMillisecond);

}  // namespace
