// SPDX-License-Identifier: Apache-2.0
// A CUDA device against its own copy: the batched combination of every rule, and fused cones of large fleets, by the
// device's clock and end to end. Prints a line a figure; no Google Benchmark, whose clock is the host's.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "device/device_combine.hpp"
#include "device/device_map.hpp"
#include "evigrid/evigrid.hpp"
#include "io/map_access.hpp"

namespace {

using namespace evigrid;
using Clock = std::chrono::steady_clock;
double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

void dense(kernels::Device& device) {
  constexpr std::size_t kPairs = std::size_t{1} << 26;
  const double copy = device.copy_rate(std::size_t{4} << 30);
  std::printf("copy: %.0f GB/s read and written\n", copy * 1e-9);
  std::vector<float> plane[6], out[3];
  std::mt19937 rng(1);
  for (auto& p : plane) p.resize(kPairs);
  for (auto& p : out) p.resize(kPairs);
  for (std::size_t i = 0; i < kPairs; ++i) {
    for (int side = 0; side < 2; ++side) {
      float a = static_cast<float>(rng() >> 8) * 0x1p-24f, b = static_cast<float>(rng() >> 8) * 0x1p-24f;
      if (a > b) std::swap(a, b);
      plane[3 * side][i] = a, plane[3 * side + 1][i] = b - a, plane[3 * side + 2][i] = 1 - b;
    }
  }
  for (const Rule rule : all_rules()) {
    if (same_as(rule) != rule) continue;
    double best = 1e9;
    for (int i = 0; i < 3; ++i) {
      combine_by_device(device, rule, {plane[0].data(), plane[1].data(), plane[2].data()},
                        {plane[3].data(), plane[4].data(), plane[5].data()},
                        {out[0].data(), out[1].data(), out[2].data()}, nullptr, kPairs);
      best = std::min(best, device.times().fuse_s);
    }
    const double bytes = 9 * sizeof(float) * static_cast<double>(kPairs);
    std::printf("dense %-14s %6.1f Gcell/s  %5.1f %% of the copy\n", std::string(name(rule)).c_str(),
                1e-9 * static_cast<double>(kPairs) / best, 100 * bytes / best / copy);
  }
}

/// Costs of all that changed, as a planner keeps them: tile by tile, by all threads.
void render_changes(const Map& map, std::uint64_t since, Executor& executor, std::vector<std::uint8_t>& out) {
  constexpr std::size_t kTile = 64 * 64;
  const Changes changes = map.changes(since);
  out.resize(changes.rects.size() * kTile);
  struct All {
    const Map& map;
    const std::vector<CellRect>& rects;
    std::uint8_t* out;
  } all{map, changes.rects, out.data()};
  executor.run(
      static_cast<std::int64_t>(changes.rects.size()),
      [](void* context, std::int64_t i, int) {
        const All& a = *static_cast<const All*>(context);
        const auto n = static_cast<std::size_t>(i);
        a.map.render(Costmap{}, a.rects[n], std::span(a.out + n * kTile, kTile), 64);
      },
      &all);
}

/// `robots` rings of 24 sonars strewn over a square of `side` cells, a scan each. Cells stay on the device from batch
/// to batch; the costs of what changed are asked for each time, the cells once, at the end.
void fleet(int robots, int side, Model model, Rule rule, bool on_device) {
  Map map({.rule = rule,
           .kernel = on_device ? Kernel::cuda : Kernel::automatic,
           .memory_cap_bytes = std::size_t{64} << 30});
  for (int i = 0; i < 24; ++i) {
    Sensor s;
    s.model = model;
    s.aperture_rad = 30 * M_PI / 180;
    s.reliability = 0.9;
    s.T_robot_sensor = {0.2 * std::cos(i * M_PI / 12), 0.2 * std::sin(i * M_PI / 12), i * M_PI / 12};
    map.add(s);
  }
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<float> ranges(static_cast<std::size_t>(robots) * 24);
  std::vector<Reading> readings(ranges.size());
  std::vector<Scan> scans(static_cast<std::size_t>(robots));
  const auto executor = make_tbb_executor();
  std::vector<std::uint8_t> costs;
  double whole = 1e9, fuse = 1e9, up = 0, render = 1e9;
  std::uint64_t cells = 0;
  constexpr int kRounds = 8;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      ranges[i] = static_cast<float>(1 + 3.4 * u(rng));
      readings[i] = {static_cast<SensorId>(i % 24), {&ranges[i], 1}};
    }
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (round == 0) scans[i].T_map_robot = {0.05 * side * u(rng), 0.05 * side * u(rng), 6 * u(rng)};
      scans[i].T_map_robot.x_m += 0.05;
      scans[i].stamp_ns = round;
      scans[i].readings = std::span(readings).subspan(i * 24, 24);
    }
    const std::uint64_t version = map.version();
    const auto begin = Clock::now();
    const Report r = map.integrate(scans);
    const auto fused = Clock::now();
    render_changes(map, version, *executor, costs);
    const double s = seconds(fused - begin), costs_s = seconds(Clock::now() - fused);
    if (round < 2) continue;  // tiles are made and sent
    render = std::min(render, costs_s);
    cells = r.cells_updated;
    if (s < whole) {
      whole = s;
      if (on_device && MapAccess::device(map) != nullptr) {
        const kernels::DeviceTimes t = MapAccess::device(map)->device().times();
        fuse = t.fuse_s, up = t.upload_s;
      }
    }
  }
  const auto before_home = Clock::now();
  (void)map.view();
  const double home = seconds(Clock::now() - before_home);
  std::printf("fleet %5d robots, grid %5d, %s + %s, %s: %6.1f M cells fused in %6.2f ms, costs %6.2f ms", robots, side,
              std::string(name(model)).c_str(), std::string(name(rule)).c_str(), std::string(map.kernel_name()).c_str(),
              1e-6 * static_cast<double>(cells), 1e3 * whole, 1e3 * render);
  if (on_device)
    std::printf("; kernels %6.2f ms = %5.2f Gcell/s, up %.2f ms; %zu tiles home in %.2f ms %s", 1e3 * fuse,
                1e-9 * static_cast<double>(cells) / fuse, 1e3 * up, map.tiles(), 1e3 * home,
                std::string(map.kernel_note()).c_str());
  std::printf("; hash %016llx\n", static_cast<unsigned long long>(map.hash()));
}

}  // namespace

int main(int argc, char** argv) {
  if (const std::string why = why_no_cuda(); !why.empty()) return std::printf("%s\n", why.c_str()), 1;
  const std::string what = argc > 1 ? argv[1] : "all";
  if (what != "fleet") {
    const auto device = kernels::make_cuda_device();
    std::printf("%s\n", device->name().c_str());
    dense(*device);
  }
  if (what == "dense") return 0;
  for (const bool on_device : {true, false}) {
    fleet(1000, 4096, Model::li2014, Rule::pcr5, on_device);
    fleet(4000, 8192, Model::li2014, Rule::pcr5, on_device);
    fleet(4000, 8192, Model::hughes1992, Rule::dempster, on_device);
  }
}
