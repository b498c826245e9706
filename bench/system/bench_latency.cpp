// SPDX-License-Identifier: Apache-2.0
// What one scan of 24 sonars costs when it comes alone: back to back (hot), after 2 ms of idling, at 100 Hz and at 10
// Hz, on every executor. Time is that of integrate() alone; counters p50_us, p99_us, max_us. Names:
// EXECUTOR/threads:T/PACE.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "evigrid/evigrid.hpp"

namespace {

using namespace evigrid;
using Clock = std::chrono::steady_clock;
using std::chrono::microseconds;

/// A ring of sonars that drives in circles through a map it has seen before.
struct Ring {
  Map map;
  std::vector<float> ranges = std::vector<float>(24);
  std::vector<Reading> readings;
  int step = 0;

  explicit Ring(std::shared_ptr<Executor> executor) : map({}, std::move(executor)) {
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const double yaw = static_cast<double>(i) * M_PI / 12;
      Sensor s;
      s.model = Model::li2014;
      s.aperture_rad = 15 * M_PI / 180;
      s.T_robot_sensor = {0.2 * std::cos(yaw), 0.2 * std::sin(yaw), yaw};
      readings.push_back({map.add(s), {&ranges[i], 1}});
    }
    for (int i = 0; i < 500; ++i) scan();
  }
  void scan() {
    for (std::size_t i = 0; i < ranges.size(); ++i)
      ranges[i] = 1 + 0.1f * static_cast<float>((static_cast<int>(i) * 37 + step * 11) % 35);
    const double t = 2 * M_PI * (step % 500) / 500;
    map.integrate(Scan{step, {5 + 2 * std::cos(t), 5 + 2 * std::sin(t), t}, readings});
    ++step;
  }
};

void scans(benchmark::State& state, const std::string& executor, int threads, microseconds idle, microseconds period) {
  Ring ring(make_executor(executor, threads));
  std::vector<double> us;
  auto next = Clock::now() + period;
  for (auto _ : state) {
    if (idle.count() > 0) std::this_thread::sleep_for(idle);
    if (period.count() > 0) {
      std::this_thread::sleep_until(next);
      next += period;
    }
    const auto begin = Clock::now();
    ring.scan();
    const double s = std::chrono::duration<double>(Clock::now() - begin).count();
    us.push_back(1e6 * s);
    state.SetIterationTime(s);
  }
  std::sort(us.begin(), us.end());
  const auto at = [&](double part) { return us[static_cast<std::size_t>(part * static_cast<double>(us.size() - 1))]; };
  state.counters["p50_us"] = at(0.5);
  state.counters["p99_us"] = at(0.99);
  state.counters["max_us"] = us.back();
}

void register_all() {
  struct Pace {
    const char* name;
    microseconds idle, period;
    int scans;
  };
  const Pace paces[] = {{"hot", microseconds(0), microseconds(0), 2000},
                        {"idle_2ms", microseconds(2000), microseconds(0), 400},
                        {"100hz", microseconds(0), microseconds(10'000), 200},
                        {"10hz", microseconds(0), microseconds(100'000), 30}};
  for (const Pace& pace : paces) {
    for (const char* executor : {"serial", "tbb", "openmp", "spin"}) {
      for (const int threads : {1, 2}) {
        if (std::string(executor) == "serial" && threads > 1) continue;
        const std::string label = std::string(executor) + "/threads:" + std::to_string(threads) + "/" + pace.name;
        benchmark::RegisterBenchmark(label.c_str(), scans, executor, threads, pace.idle, pace.period)
            ->Iterations(pace.scans)
            ->UseManualTime()
            ->Unit(benchmark::kMicrosecond);
      }
    }
  }
}

const bool registered = (register_all(), true);

}  // namespace
