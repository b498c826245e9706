// SPDX-License-Identifier: Apache-2.0
// Dense combination in place (A ⊕= B, 36 bytes moved a cell) beside a memory-only loop of the same pattern in the same
// binary and run: three planes read and written, three read. Compare cells/s within one run only.
// Usage: bench_dense --benchmark_enable_random_interleaving=true --benchmark_repetitions=9
// --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "evigrid/evigrid.hpp"

namespace {

using namespace evigrid;

struct Arrays {
  std::vector<float> e, o, u;
  Arrays(std::size_t n, float base) : e(n), o(n), u(n) {
    for (std::size_t i = 0; i < n; ++i) {
      e[i] = base + 0.3f * static_cast<float>(i * 2654435761u >> 16 & 0xffff) / 65536;
      o[i] = base + 0.3f * static_cast<float>(i * 40503u >> 4 & 0xffff) / 65536;
      u[i] = 1 - e[i] - o[i];
    }
  }
};
struct Operands {
  Arrays a, b;
  bool plane_by_plane = false;
  explicit Operands(std::size_t n) : a(n, 0.05f), b(n, 0.02f) {}
};
Operands& operands(std::size_t n) {  // kept between benchmarks: first touch is not what is measured
  static std::size_t have = 0;
  static std::unique_ptr<Operands> kept;
  if (have != n) kept = std::make_unique<Operands>(n), have = n;
  return *kept;
}

constexpr std::size_t kBlock = 1 << 16;

/// Compiled for the widest vectors of the processor, as the kernels are: the yardstick must not be the weaker side.
__attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default"))) void subtract(float* __restrict a,
                                                                                            const float* __restrict b,
                                                                                            std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) a[i] = b[i] - a[i];
}

/// The kernels' pattern: six streams walked side by side.
__attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default"))) void subtract_planes(
    float* __restrict ae, float* __restrict ao, float* __restrict au, const float* __restrict be,
    const float* __restrict bo, const float* __restrict bu, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    ae[i] = be[i] - ae[i];
    ao[i] = bo[i] - ao[i];
    au[i] = bu[i] - au[i];
  }
}

void memory_loop(benchmark::State& state, bool plane_by_plane) {
  const auto n = static_cast<std::size_t>(state.range(0));
  Operands& x = operands(n);
  x.plane_by_plane = plane_by_plane;
  const auto executor = make_tbb_executor(static_cast<int>(state.range(1)));
  for (auto _ : state) {
    executor->run(
        static_cast<std::int64_t>((n + kBlock - 1) / kBlock),
        [](void* p, std::int64_t i, int) {
          auto& q = *static_cast<Operands*>(p);
          const std::size_t begin = static_cast<std::size_t>(i) * kBlock, end = std::min(begin + kBlock, q.a.e.size());
          const std::size_t count = end - begin;
          float *ae = q.a.e.data() + begin, *ao = q.a.o.data() + begin, *au = q.a.u.data() + begin;
          const float *be = q.b.e.data() + begin, *bo = q.b.o.data() + begin, *bu = q.b.u.data() + begin;
          if (q.plane_by_plane) {
            subtract(ae, be, count);
            subtract(ao, bo, count);
            subtract(au, bu, count);
          } else {
            subtract_planes(ae, ao, au, be, bo, bu, count);
          }
        },
        &x);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(n) * 36);
  state.SetLabel("memory loop, threads " + std::to_string(state.range(1)));
  operands(1), operands(n);  // the loop leaves no masses behind: fresh operands for the next
}

void combine_in_place(benchmark::State& state, Rule rule) {
  const auto n = static_cast<std::size_t>(state.range(0));
  Operands& x = operands(n);
  const auto executor = make_tbb_executor(static_cast<int>(state.range(1)));
  const Planes<float> a{x.a.e.data(), x.a.o.data(), x.a.u.data()};
  for (auto _ : state) {
    combine(rule, {a.e, a.o, a.u}, {x.b.e.data(), x.b.o.data(), x.b.u.data()}, a, nullptr, n, Kernel::automatic,
            executor.get());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(n) * 36);
  state.SetLabel(std::string(name(rule)) + ", " + std::string(resolve_kernel_name(Kernel::automatic)) + ", threads " +
                 std::to_string(state.range(1)));
}

void sizes(benchmark::internal::Benchmark* b) {
  for (const int threads : {1, 2}) b->Args({16 << 20, threads});
  b->UseRealTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(memory_loop, side_by_side, false)->Apply(sizes);
BENCHMARK_CAPTURE(memory_loop, plane_by_plane, true)->Apply(sizes);
BENCHMARK_CAPTURE(combine_in_place, dempster, Rule::dempster)->Apply(sizes);
BENCHMARK_CAPTURE(combine_in_place, pcr2, Rule::pcr2)->Apply(sizes);
BENCHMARK_CAPTURE(combine_in_place, pcr5, Rule::pcr5)->Apply(sizes);
BENCHMARK_CAPTURE(combine_in_place, germ_pcr2, Rule::germ_pcr2)->Apply(sizes);
BENCHMARK_CAPTURE(combine_in_place, yager, Rule::yager)->Apply(sizes);
BENCHMARK_CAPTURE(combine_in_place, pcr1, Rule::pcr1)->Apply(sizes);
BENCHMARK_CAPTURE(combine_in_place, pcr4, Rule::pcr4)->Apply(sizes);
BENCHMARK_CAPTURE(combine_in_place, disjunctive, Rule::disjunctive)->Apply(sizes);
BENCHMARK_CAPTURE(combine_in_place, cautious, Rule::cautious)->Apply(sizes);
BENCHMARK_CAPTURE(combine_in_place, murphy, Rule::murphy)->Apply(sizes);
BENCHMARK_CAPTURE(combine_in_place, bayes, Rule::bayes)->Apply(sizes);

}  // namespace
