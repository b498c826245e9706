// SPDX-License-Identifier: Apache-2.0
// Arithmetic's side of bench/machine.hpp: 16 independent chains in registers hide the latency of 4 cycles on two ports.
#include <benchmark/benchmark.h>
#include <immintrin.h>

#include <cstdint>

#include "bench/machine.hpp"
#include "evigrid/executor.hpp"

namespace evigrid::bench {
namespace {

constexpr int kChains = 16;
constexpr std::int64_t kSteps = 1 << 14;

/// Each answers the number of floats that one step of one chain works on.
#define EVIGRID_CHAINS(name, isa, vector, lanes, set1, step)                    \
  __attribute__((target(isa))) int name(float seed, float* out) {               \
    vector acc[kChains];                                                        \
    const vector m = set1(seed), a = set1(1 - seed);                            \
    for (int c = 0; c < kChains; ++c) acc[c] = set1(static_cast<float>(c));     \
    for (std::int64_t i = 0; i < kSteps; ++i) {                                 \
      _Pragma("GCC unroll 16") for (int c = 0; c < kChains; ++c) acc[c] = step; \
    }                                                                           \
    vector sum = acc[0];                                                        \
    for (int c = 1; c < kChains; ++c) sum += acc[c];                            \
    *out = sum[0];                                                              \
    return lanes;                                                               \
  }
EVIGRID_CHAINS(fma_512, "avx512f", __m512, 16, _mm512_set1_ps, _mm512_fmadd_ps(acc[c], m, a))
EVIGRID_CHAINS(fma_256, "avx2,fma", __m256, 8, _mm256_set1_ps, _mm256_fmadd_ps(acc[c], m, a))
EVIGRID_CHAINS(mul_add_512, "avx512f", __m512, 16, _mm512_set1_ps, acc[c] * m + a)
EVIGRID_CHAINS(mul_add_256, "avx2", __m256, 8, _mm256_set1_ps, acc[c] * m + a)
EVIGRID_CHAINS(mul_add_128, "sse2", __m128, 4, _mm_set1_ps, acc[c] * m + a)

using Chains = int (*)(float, float*);

void peak(benchmark::State& state, Chains chains) {
  const int threads = static_cast<int>(state.range(0));
  const auto executor = make_tbb_executor(threads);
  int lanes = 0;
  struct Context {
    Chains chains;
    int* lanes;
  } context{chains, &lanes};
  float ignored = 0;
  lanes = chains(0.5f, &ignored);
  for (auto _ : state) {
    executor->run(
        32 * threads,
        [](void* p, std::int64_t, int) {
          float out = 0;
          static_cast<Context*>(p)->chains(0.999f, &out);
          benchmark::DoNotOptimize(out);
        },
        &context);
  }
  const auto flop = static_cast<double>(state.iterations()) * 32 * threads * kSteps * kChains * lanes * 2;
  state.counters["flop/s"] = benchmark::Counter(flop, benchmark::Counter::kIsRate);
}

}  // namespace

void register_peak() {
  const bool wide = __builtin_cpu_supports("avx512f") != 0;
  const bool middle = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  const auto with_threads = [](benchmark::internal::Benchmark* b) {
    b->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
  };
  if (wide || middle) with_threads(benchmark::RegisterBenchmark("machine/peak_fma", peak, wide ? fma_512 : fma_256));
  with_threads(benchmark::RegisterBenchmark("machine/peak_mul_add", peak,
                                            wide     ? mul_add_512
                                            : middle ? mul_add_256
                                                     : mul_add_128));
}

}  // namespace evigrid::bench
