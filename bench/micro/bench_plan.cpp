// SPDX-License-Identifier: Apache-2.0
// From a floor plan's bytes to a world that can be cast in: read, trace, set up; for a generated plan of 3000 × 3000
// pixels and, where the data folder has them, for two recorded ones. Counters: pixels per second, segments, and the
// range error that simplified outlines cost (the same rays cast in exact and in simplified ones; cm and quantiles).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "evigrid/raycast/scene.hpp"
#include "evigrid/scenes/plan.hpp"

namespace {

using namespace evigrid;

struct Source {
  std::string name, bytes;  ///< the name's extension says the format
  scenes::ImageScale scale;

  [[nodiscard]] scenes::FloorPlan load() const {
    return scenes::load_plan_bytes(std::as_bytes(std::span(bytes.data(), bytes.size())), name, scale);
  }
};

/// Rooms of 4 m at 5 cm with walls of 15 cm and doors, slanted walls, and speckles as a scan leaves them. PGM.
Source generated(int side) {
  std::string pixels(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), '\xfe');
  const auto set = [&](double x, double y) {
    const auto ix = static_cast<std::int64_t>(x), iy = static_cast<std::int64_t>(y);
    if (ix >= 0 && iy >= 0 && ix < side && iy < side) pixels[static_cast<std::size_t>(iy * side + ix)] = 0;
  };
  std::mt19937 random(5);
  constexpr int room = 80, wall = 3, door = 20;
  for (int line = 0; line + wall <= side; line += room)
    for (int along = 0; along < side; ++along) {
      if (along % room > room / 2 && along % room < room / 2 + door) continue;
      for (int k = 0; k < wall; ++k) {
        set(line + k, along);
        set(along, line + k);
      }
    }
  for (int i = 0; i < side / 10; ++i) {
    const double angle = 1e-3 * (random() % 6283), length = 20 + random() % 200;
    const double x = random() % static_cast<unsigned>(side), y = random() % static_cast<unsigned>(side);
    for (double t = 0; t < length; t += 0.5)
      for (double k = 0; k < wall; k += 0.5)
        set(x + t * std::cos(angle) - k * std::sin(angle), y + t * std::sin(angle) + k * std::cos(angle));
  }
  for (int i = 0; i < side * side / 2000; ++i)
    set(random() % static_cast<unsigned>(side), random() % static_cast<unsigned>(side));
  const std::string size = std::to_string(side);
  return {"generated.pgm", "P5 " + size + " " + size + " 255\n" + pixels, {.resolution_m = 0.05}};
}

Source from_file(const std::filesystem::path& path, const scenes::ImageScale& scale) {
  std::ifstream in(path, std::ios::binary);
  return {path.string(), {std::istreambuf_iterator<char>(in), {}}, scale};
}

scenes::TraceOptions options(bool exact) { return {.simplify_px = exact ? 0.0 : scenes::TraceOptions{}.simplify_px}; }

void read(benchmark::State& state, const Source& source) {
  double pixels = 0;
  for (auto _ : state) {
    const scenes::FloorPlan plan = source.load();
    pixels = static_cast<double>(plan.cells.size());
    benchmark::DoNotOptimize(plan.cells.data());
  }
  state.counters["pixels/s"] = benchmark::Counter(pixels, benchmark::Counter::kIsIterationInvariantRate);
}

void trace(benchmark::State& state, const Source& source, bool exact) {
  const scenes::FloorPlan plan = source.load();
  std::size_t segments = 0;
  for (auto _ : state) {
    segments = 0;
    for (const raycast::Polygon& p : scenes::trace(plan, options(exact))) segments += p.vertices.size();
  }
  state.counters["segments"] = static_cast<double>(segments);
  state.counters["pixels/s"] =
      benchmark::Counter(static_cast<double>(plan.cells.size()), benchmark::Counter::kIsIterationInvariantRate);
}

void set_up(benchmark::State& state, const Source& source, bool exact) {
  raycast::World world;
  world.polygons = scenes::trace(source.load(), options(exact));
  std::size_t segments = 0;
  for (auto _ : state) segments = raycast::Scene(world).surface_count();
  state.counters["segments"] = static_cast<double>(segments);
}

/// Rays in simplified outlines from random free pixels with two free pixels around.
void range_error(benchmark::State& state, const Source& source) {
  const scenes::FloorPlan plan = source.load();
  raycast::World exact_world, simple_world;
  exact_world.polygons = scenes::trace(plan, options(true));
  simple_world.polygons = scenes::trace(plan, options(false));
  const raycast::Scene exact(exact_world), simple(simple_world);
  std::mt19937 random(6);
  struct Ray {
    double x_m, y_m, angle_rad;
  };
  std::vector<Ray> rays;
  const double c = std::cos(plan.origin.yaw_rad), s = std::sin(plan.origin.yaw_rad);
  while (rays.size() < 50'000) {
    const std::int64_t x = 2 + random() % (plan.width - 4), y = 2 + random() % (plan.height - 4);
    bool clear = true;
    for (std::int64_t v = -2; v <= 2; ++v)
      for (std::int64_t u = -2; u <= 2; ++u) clear &= plan.at(x + u, y + v) == scenes::PlanCell::free;
    if (!clear) continue;
    const double px = (static_cast<double>(x) + 0.5) * plan.resolution_m;
    const double py = (static_cast<double>(y) + 0.5) * plan.resolution_y_m;
    rays.push_back({plan.origin.x_m + c * px - s * py, plan.origin.y_m + s * px + c * py,
                    2e-3 * std::numbers::pi * (random() % 1000)});
  }
  constexpr double most_m = 1000;
  std::vector<double> simple_m(rays.size());
  for (auto _ : state)
    for (std::size_t i = 0; i < rays.size(); ++i)
      simple_m[i] = std::min(most_m, simple.ray_range(rays[i].x_m, rays[i].y_m, rays[i].angle_rad, most_m));
  std::vector<double> error_cm;
  std::size_t farther = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double m = std::min(most_m, exact.ray_range(rays[i].x_m, rays[i].y_m, rays[i].angle_rad, most_m));
    error_cm.push_back(100 * std::abs(simple_m[i] - m));
    farther += simple_m[i] > m + scenes::TraceOptions{}.simplify_px * plan.resolution_m;
  }
  std::sort(error_cm.begin(), error_cm.end());
  state.counters["median_cm"] = error_cm[error_cm.size() / 2];
  state.counters["p95_cm"] = error_cm[error_cm.size() * 95 / 100];
  state.counters["p99_cm"] = error_cm[error_cm.size() * 99 / 100];
  state.counters["farther_share"] = static_cast<double>(farther) / static_cast<double>(rays.size());
}

void add(const std::string& label, const Source& source) {
  const auto name = [&](const char* what) { return "plan/" + label + "/" + what; };
  using benchmark::RegisterBenchmark;
  const auto unit = benchmark::kMillisecond;
  RegisterBenchmark(name("read").c_str(), [=](benchmark::State& s) { read(s, source); })->Unit(unit);
  for (const bool exact : {true, false}) {
    const std::string kind = exact ? "_exact" : "_simplified";
    RegisterBenchmark(name(("trace" + kind).c_str()).c_str(), [=](benchmark::State& s) {
      trace(s, source, exact);
    })->Unit(unit);
    RegisterBenchmark(name(("scene" + kind).c_str()).c_str(), [=](benchmark::State& s) {
      set_up(s, source, exact);
    })->Unit(unit);
  }
  RegisterBenchmark(name("cast_50000_rays").c_str(), [=](benchmark::State& s) { range_error(s, source); })->Unit(unit);
}

const bool registered = [] {
  add("generated_3000", generated(3000));
  const std::filesystem::path maps = std::filesystem::path(EVIGRID_DATA_DIR) / "maps";
  const std::filesystem::path willow = maps / "ros-willow/willow-2010-02-18-0.10.yaml";
  if (std::filesystem::exists(willow)) add("willow", from_file(willow, {}));
  for (const char* name : {"lab_ipa", "lab_intel", "Freiburg79_scan"}) {
    const std::filesystem::path file = maps / "ipa-rooms" / (std::string(name) + ".png");
    if (std::filesystem::exists(file)) add(name, from_file(file, {.resolution_m = 0.05}));
  }
  return true;
}();

}  // namespace
