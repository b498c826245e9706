// SPDX-License-Identifier: Apache-2.0
// Fused cones: 24 sonars a scan, one thread, cells counted. items = cells.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "evigrid/evigrid.hpp"

namespace {

using namespace evigrid;

void ring(benchmark::State& state, Model model, Rule rule, Kernel kernel) {
  if (!kernel_available(kernel)) {
    state.SkipWithError("this processor cannot run the kernel");
    return;
  }
  Map map({.rule = rule, .kernel = kernel, .keep_conflict = state.range(0) != 0}, make_serial_executor());
  std::vector<float> ranges(24);
  std::vector<Reading> readings;
  for (int i = 0; i < 24; ++i) {
    Sensor s;
    s.model = model;
    s.aperture_rad = 30 * M_PI / 180;
    s.T_robot_sensor = {0.2 * std::cos(i * M_PI / 12), 0.2 * std::sin(i * M_PI / 12), i * M_PI / 12};
    readings.push_back({map.add(s), {&ranges[static_cast<std::size_t>(i)], 1}});
  }
  std::uint64_t cells = 0;
  int step = 0;
  for (auto _ : state) {
    for (int i = 0; i < 24; ++i)
      ranges[static_cast<std::size_t>(i)] = 1 + 0.1f * static_cast<float>((i * 37 + step * 11) % 35);
    cells += map.integrate(Scan{step, {5 + 0.01 * (step % 500), 5 + 0.007 * (step % 300), 0.1 * step}, readings})
                 .cells_updated;
    ++step;
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(cells));
  state.SetLabel("30 degree cones, 1 thread");
}
#define EVIGRID_RING(model, rule)                                                                     \
  BENCHMARK_CAPTURE(ring, model##_##rule##_scalar, Model::model, Rule::rule, Kernel::scalar)->Arg(1); \
  BENCHMARK_CAPTURE(ring, model##_##rule##_avx2, Model::model, Rule::rule, Kernel::avx2)->Arg(1);     \
  BENCHMARK_CAPTURE(ring, model##_##rule##_avx512, Model::model, Rule::rule, Kernel::avx512)->Arg(0)->Arg(1)
EVIGRID_RING(li2014, pcr5);
EVIGRID_RING(li2014, germ_pcr2);
EVIGRID_RING(hughes1992, dempster);

}  // namespace
