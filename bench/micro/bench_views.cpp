// SPDX-License-Identifier: Apache-2.0
// What reading while writing costs. A robot with 24 sonars drives through a map of N × N tiles that are all there:
// fuse/none without a view, fuse/held beside one old view (each tile is copied once, ever), fuse/every with a new view
// after every scan (the tiles of every scan are copied). view: making one after a scan, and after nothing changed.
// save and load: bytes are those of the map in memory; memcpy of the same bytes and write + fsync of them to the same
// folder beside it. Prepares its own map, needs no data.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <sstream>
#include <vector>

#include "evigrid/evigrid.hpp"

namespace {

using namespace evigrid;

constexpr double kTile_m = 64 * 0.05;

/// A map whose every tile exists, and a robot in it.
struct World {
  Map map{{.rule = Rule::pcr5, .memory_cap_bytes = std::size_t{8} << 30}, make_serial_executor()};
  std::vector<float> ranges = std::vector<float>(24);
  std::vector<Reading> readings;
  int side, step = 0;

  explicit World(int tiles_a_side) : side(tiles_a_side) {
    for (int i = 0; i < 24; ++i) {
      Sensor s;
      s.aperture_rad = 30 * M_PI / 180;
      s.T_robot_sensor = {0.2 * std::cos(i * M_PI / 12), 0.2 * std::sin(i * M_PI / 12), i * M_PI / 12};
      readings.push_back({map.add(s), {&ranges[static_cast<std::size_t>(i)], 1}});
    }
    for (int y = 0; y < side; y += 2) {
      for (int x = 0; x < side; x += 2) scan_at({(x + 1) * kTile_m, (y + 1) * kTile_m, 0.1 * x});
    }
  }
  Report scan_at(const Pose2& pose) {
    for (std::size_t i = 0; i < 24; ++i)
      ranges[i] = 1 + 0.1f * static_cast<float>((i * 37 + static_cast<std::size_t>(step) * 11) % 35);
    return map.integrate(Scan{step++, pose, readings});
  }
  Report scan() {  // a drive along the diagonal
    const double way = std::fmod(0.01 * step, (side - 4) * kTile_m);
    return scan_at({2 * kTile_m + way, 2 * kTile_m + way, 0.1 * step});
  }
};

enum class Held { none, held, every };
void fuse(benchmark::State& state, Held held) {
  World w(static_cast<int>(state.range(0)));
  std::optional<MapView> view;
  if (held == Held::held) view = w.map.view();
  std::uint64_t cells = 0;
  for (auto _ : state) {
    cells += w.scan().cells_updated;
    if (held == Held::every) view = w.map.view();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(cells));
  state.counters["tiles"] = static_cast<double>(w.map.tiles());
}
BENCHMARK_CAPTURE(fuse, none, Held::none)->Arg(32)->Arg(128);
BENCHMARK_CAPTURE(fuse, held, Held::held)->Arg(32)->Arg(128);
BENCHMARK_CAPTURE(fuse, every, Held::every)->Arg(32)->Arg(128);

/// Tiles a scan touches: what fuse/every copies.
void view_after_a_scan(benchmark::State& state) {
  World w(static_cast<int>(state.range(0)));
  std::optional<MapView> view = w.map.view();
  for (auto _ : state) {
    state.PauseTiming();
    w.scan();
    state.ResumeTiming();
    view = w.map.view();
  }
  state.counters["tiles"] = static_cast<double>(w.map.tiles());
}
BENCHMARK(view_after_a_scan)->Arg(32)->Arg(128)->Iterations(3000);

void view_of_an_unchanged_map(benchmark::State& state) {
  World w(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(w.map.view());
}
BENCHMARK(view_of_an_unchanged_map)->Arg(32)->Arg(128);

/// Of a map that had none: a map loaded from the file of the other.
void first_view(benchmark::State& state) {
  World w(static_cast<int>(state.range(0)));
  std::ostringstream out;
  save(w.map, out);
  const std::string bytes = out.str();
  for (auto _ : state) {
    state.PauseTiming();
    {
      Map fresh = load(std::as_bytes(std::span(bytes)), {.executor = make_serial_executor()});
      std::optional<MapView> view;
      state.ResumeTiming();
      view = fresh.view();
      state.PauseTiming();
    }
    state.ResumeTiming();
  }
}
BENCHMARK(first_view)->Arg(32)->Iterations(5)->Unit(benchmark::kMicrosecond);

/// A window of 32 × 32 tiles that moves on by one column of them.
void shift_of_a_window(benchmark::State& state) {
  World w(static_cast<int>(state.range(0)));
  std::int64_t x = 0;
  w.map.set_window({0, 0, 2048, 2048});
  for (auto _ : state) {
    state.PauseTiming();
    if (x > 20) {
      w.map.set_window({});
      for (int y = 0; y < 32; y += 2) w.scan_at({(x + 33) * kTile_m, (y + 1) * kTile_m, 0.1});
    }
    x = x > 20 ? 0 : x + 1;
    state.ResumeTiming();
    w.map.set_window({64 * x, 0, 2048, 2048});
  }
}
BENCHMARK(shift_of_a_window)->Arg(64)->Iterations(20)->Unit(benchmark::kMicrosecond);

struct Scratch {
  std::filesystem::path file = std::filesystem::temp_directory_path() / ("evigrid-bench-" + std::to_string(::getpid()));
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
  }
};

void save_view(benchmark::State& state) {
  World w(32);
  const MapView view = w.map.view();
  const Scratch to;
  const auto executor = make_tbb_executor(static_cast<int>(state.range(0)));
  for (auto _ : state) save(view, to.file, executor.get());
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * w.map.memory_bytes()));
  state.counters["file/memory"] =
      static_cast<double>(std::filesystem::file_size(to.file)) / static_cast<double>(w.map.memory_bytes());
}
BENCHMARK(save_view)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void load_file(benchmark::State& state) {
  World w(32);
  const Scratch from;
  save(w.map, from.file);
  const std::shared_ptr<Executor> executor = make_tbb_executor(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(load(from.file, {.executor = executor}).tiles());
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * w.map.memory_bytes()));
}
BENCHMARK(load_file)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

/// A square of so many tiles out of the middle of 33 × 33: its own bytes in memory count.
void load_region(benchmark::State& state) {
  World w(32);
  const Scratch from;
  save(w.map, from.file);
  const std::shared_ptr<Executor> executor = make_serial_executor();
  const std::int64_t side = 64 * state.range(0);
  std::uint64_t bytes_read = 0;
  std::size_t memory = 0;
  for (auto _ : state) {
    const Map part = load(from.file, {.executor = executor,
                                      .region = CellRect{1024 - side / 2, 1024 - side / 2, side, side},
                                      .bytes_read = &bytes_read});
    memory = part.memory_bytes();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * memory));
  state.counters["read/file"] =
      static_cast<double>(bytes_read) / static_cast<double>(std::filesystem::file_size(from.file));
}
BENCHMARK(load_region)->Arg(2)->Arg(8)->Arg(16)->UseRealTime()->Unit(benchmark::kMillisecond);

/// From the page cache, as load_file mostly has them.
void read_the_saved_bytes(benchmark::State& state) {
  World w(32);
  const Scratch from;
  save(w.map, from.file);
  const auto n = static_cast<std::size_t>(std::filesystem::file_size(from.file));
  std::vector<char> to(n);
  for (auto _ : state) {
    const int d = ::open(from.file.c_str(), O_RDONLY | O_CLOEXEC);
    for (std::size_t at = 0; at < n;) {
      const ssize_t got = ::read(d, to.data() + at, n - at);
      if (got <= 0) break;
      at += static_cast<std::size_t>(got);
    }
    ::close(d);
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * n));
}
BENCHMARK(read_the_saved_bytes)->UseRealTime()->Unit(benchmark::kMillisecond);

void copy_the_same_bytes(benchmark::State& state) {
  const std::size_t n = World(32).map.memory_bytes();
  std::vector<char> from(n, 1), to(n, 2);
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), n);
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * n));
}
BENCHMARK(copy_the_same_bytes)->Unit(benchmark::kMillisecond);

void write_the_same_bytes(benchmark::State& state) {
  const std::size_t n = World(32).map.memory_bytes();
  const std::vector<char> from(n, 1);
  const Scratch to;
  for (auto _ : state) {
    const int d = ::open(to.file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    for (std::size_t at = 0; at < n;) {
      const ssize_t wrote = ::write(d, from.data() + at, n - at);
      if (wrote <= 0) break;
      at += static_cast<std::size_t>(wrote);
    }
    ::fsync(d);
    ::close(d);
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * n));
}
BENCHMARK(write_the_same_bytes)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
