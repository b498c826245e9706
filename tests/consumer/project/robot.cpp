// SPDX-License-Identifier: Apache-2.0
// A robot of somebody else: eight sonars in a square room, cast, fused, read by a planner thread, saved and loaded. It
// sees the installed headers alone, and brings threads of its own.
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numbers>
#include <thread>
#include <vector>

#include <evigrid/evigrid.hpp>
#include <evigrid/raycast/scene.hpp>

namespace {

/// The host's executor: the map runs on the threads that the robot has anyway.
class HostThreads final : public evigrid::Executor {
 public:
  int concurrency() const noexcept override { return 2; }
  std::string_view name() const noexcept override { return "host"; }
  void run(std::int64_t count, Task task, void* context) override {
    std::exception_ptr thrown[2];
    const auto half = [&](int worker) {
      try {
        for (std::int64_t i = worker; i < count; i += 2) task(context, i, worker);
      } catch (...) {
        thrown[worker] = std::current_exception();
      }
    };
    std::thread other(half, 1);
    half(0);
    other.join();
    for (const std::exception_ptr& t : thrown) {
      if (t) std::rethrow_exception(t);
    }
  }
};

int fail(const char* what) {
  std::fprintf(stderr, "%s\n", what);
  return 1;
}

}  // namespace

int main() {
  using namespace evigrid;
  raycast::World room;
  room.polygons.push_back({{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}, {}});
  const raycast::Scene scene(room);

  Map map({.cell_m = 0.05, .rule = Rule::pcr5}, std::make_shared<HostThreads>());
  Map alone({.cell_m = 0.05, .rule = Rule::pcr5}, make_serial_executor());
  std::vector<SensorId> ring;
  for (int i = 0; i < 8; ++i) {
    Sensor s;
    s.T_robot_sensor = {0, 0, i * std::numbers::pi / 4};
    ring.push_back(map.add(s));
    alone.add(s);
  }
  LatestView latest;
  Report sum;
  for (int step = 0; step < 20; ++step) {
    const Pose2 robot{-1 + 0.1 * step, 0.5, 0.05 * step};
    std::vector<float> ranges;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Sensor& s = map.sensors()[i];
      const Pose2 at = compose(robot, s.T_robot_sensor);
      ranges.push_back(static_cast<float>(
          scene.cast_cone({at.x_m, at.y_m, at.yaw_rad, s.aperture_rad, s.min_range_m, s.max_range_m}).range_m));
    }
    std::vector<Reading> readings;
    for (std::size_t i = 0; i < ring.size(); ++i) readings.push_back({ring[i], std::span(&ranges[i], 1)});
    sum += map.integrate({step * 100'000'000LL, robot, readings});
    alone.integrate({step * 100'000'000LL, robot, readings});
    latest.set(map.view());
  }
  if (sum.readings_used != 160) return fail("not every reading was used");
  if (map.executor_name() != "host") return fail("the host's threads were not used");
  if (map.hash() != alone.hash()) return fail("two threads gave another map than one");
  if (latest.get()->mass(map.cell_at(0, 0)).e < 0.5f) return fail("the middle of the room is not empty");

  const auto path = std::filesystem::temp_directory_path() / ("evigrid-consumer-" + std::to_string(map.hash()));
  save(*latest.get(), path);
  const bool same = load(path).hash() == map.hash();
  try {
    (void)load(path.string() + ".not-there");
    return fail("a file that is not there was loaded");
  } catch (const MapFileError& e) {  // an exception that crosses the library's border
    if (std::string(e.what()).find("not-there") == std::string::npos) return fail("the error names no file");
  }
  std::filesystem::remove(path);
  if (!same) return fail("the loaded map is another one");
  std::printf("evigrid %s, %zu tiles, kernel %s\n", EVIGRID_VERSION, map.tiles(), std::string(map.kernel_name()).c_str());
}
