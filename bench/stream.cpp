// SPDX-License-Identifier: Apache-2.0
// Memory's side of bench/machine.hpp. Every loop is compiled for the widest vectors of the processor, as the kernels
// are: a yardstick must not be the weaker side. Compiled with -fno-tree-loop-distribute-patterns, or the copy becomes a
// call of memcpy, whose stores bypass the caches.
#include <benchmark/benchmark.h>
#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "bench/machine.hpp"
#include "evigrid/executor.hpp"

namespace evigrid::bench {
namespace {

#define EVIGRID_WIDEST __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))

constexpr std::size_t kElements = std::size_t{32} << 20, kBlock = 1 << 16;

/// Six arrays at most; a loop takes what it needs. Untouched pages cost nothing.
struct Arrays {
  float* a[6];
};
using Loop = void (*)(const Arrays&, std::size_t begin, std::size_t end);

EVIGRID_WIDEST void copy(const Arrays& x, std::size_t begin, std::size_t end) {
  float* __restrict a = x.a[0], * __restrict b = x.a[1];
  for (std::size_t i = begin; i < end; ++i) a[i] = b[i];
}
EVIGRID_WIDEST void scale(const Arrays& x, std::size_t begin, std::size_t end) {
  float* __restrict a = x.a[0], * __restrict b = x.a[1];
  for (std::size_t i = begin; i < end; ++i) a[i] = 0.7f * b[i];
}
EVIGRID_WIDEST void add(const Arrays& x, std::size_t begin, std::size_t end) {
  float* __restrict a = x.a[0], * __restrict b = x.a[1], * __restrict c = x.a[2];
  for (std::size_t i = begin; i < end; ++i) a[i] = b[i] + c[i];
}
EVIGRID_WIDEST void triad(const Arrays& x, std::size_t begin, std::size_t end) {
  float* __restrict a = x.a[0], * __restrict b = x.a[1], * __restrict c = x.a[2];
  for (std::size_t i = begin; i < end; ++i) a[i] = b[i] + 0.7f * c[i];
}
EVIGRID_WIDEST void scale_in_place(const Arrays& x, std::size_t begin, std::size_t end) {
  float* __restrict a = x.a[0];
  for (std::size_t i = begin; i < end; ++i) a[i] = 1 - a[i];
}
EVIGRID_WIDEST void read4_write2(const Arrays& x, std::size_t begin, std::size_t end) {
  float* __restrict p = x.a[0], * __restrict q = x.a[1];
  const float* __restrict b = x.a[2], * __restrict c = x.a[3], * __restrict d = x.a[4], * __restrict e = x.a[5];
  for (std::size_t i = begin; i < end; ++i) {
    p[i] = b[i] + c[i];
    q[i] = d[i] - e[i];
  }
}
struct Row {
  const char* name;
  Loop loop;
  int bytes;  ///< an element, as STREAM counts
};
constexpr Row kRows[] = {{"copy", copy, 8},
                         {"scale", scale, 8},
                         {"add", add, 12},
                         {"triad", triad, 12},
                         {"in_place", scale_in_place, 8},
                         {"read4_write2", read4_write2, 24}};

/// Whole pages, wished huge or not; touched by the first pass over them.
struct Memory {
  std::size_t bytes;
  void* p;
  Memory(std::size_t n, bool huge) : bytes(n), p(std::aligned_alloc(2u << 20, n)) {
    if (p == nullptr) std::abort();
    madvise(p, bytes, huge ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
    auto* f = static_cast<float*>(p);
    for (std::size_t i = 0; i < bytes / sizeof(float); ++i) f[i] = 0.5f;
  }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory() { std::free(p); }
};

void stream(benchmark::State& state, Row row, int arrays) {
  static std::unique_ptr<Memory> memory[6];  // kept: first touch is not what is measured
  Arrays x{};
  for (int i = 0; i < arrays; ++i) {
    if (!memory[i]) memory[i] = std::make_unique<Memory>(kElements * sizeof(float), true);
    x.a[i] = static_cast<float*>(memory[i]->p);
  }
  const auto executor = make_tbb_executor(static_cast<int>(state.range(0)));
  struct Context {
    const Row& row;
    const Arrays& x;
  } context{row, x};
  for (auto _ : state) {
    executor->run(
        kElements / kBlock,
        [](void* p, std::int64_t i, int) {
          const auto& c = *static_cast<Context*>(p);
          const std::size_t begin = static_cast<std::size_t>(i) * kBlock;
          c.row.loop(c.x, begin, begin + kBlock);
        },
        &context);
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(kElements) * row.bytes);
}

/// Each worker on arrays of its own, 64 tasks a worker, each long enough for the hand-over not to count.
void l2_triad(benchmark::State& state) {
  constexpr std::size_t kFloats = 200 * 1024 / sizeof(float), kPad = 1024, kPasses = 32;
  const int threads = static_cast<int>(state.range(0));
  std::vector<std::vector<float>> own(static_cast<std::size_t>(threads),
                                      std::vector<float>(3 * kFloats + 2 * kPad, 0.5f));
  const auto executor = make_tbb_executor(threads);
  for (auto _ : state) {
    executor->run(
        64 * threads,
        [](void* p, std::int64_t, int worker) {
          float* at = (*static_cast<std::vector<std::vector<float>>*>(p))[static_cast<std::size_t>(worker)].data();
          const Arrays x{{at, at + kFloats + kPad, at + 2 * (kFloats + kPad), nullptr, nullptr, nullptr}};
          for (std::size_t pass = 0; pass < kPasses; ++pass) triad(x, 0, kFloats);
        },
        &own);
  }
  state.SetBytesProcessed(state.iterations() * 64 * threads * static_cast<std::int64_t>(kPasses * kFloats * 12));
}

constexpr std::size_t kRandomBytes = std::size_t{512} << 20, kMicroFloats = 48;

EVIGRID_WIDEST void micro_in_place(float* __restrict p) {
  for (std::size_t i = 0; i < kMicroFloats; ++i) p[i] = 1 - p[i];
}
void random_micro(benchmark::State& state, bool huge) {
  const Memory memory(kRandomBytes, huge);
  constexpr std::size_t kTasks = 512, kPerTask = 4096, kMicros = kRandomBytes / (kMicroFloats * sizeof(float));
  const auto executor = make_tbb_executor(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    executor->run(
        kTasks,
        [](void* p, std::int64_t task, int) {
          auto* f = static_cast<float*>(static_cast<const Memory*>(p)->p);
          std::uint64_t x = static_cast<std::uint64_t>(task) * 0x9E3779B97F4A7C15u + 1;
          for (std::size_t i = 0; i < kPerTask; ++i) {
            x = x * 6364136223846793005u + 1442695040888963407u;
            micro_in_place(f + (x >> 33) % kMicros * kMicroFloats);
          }
        },
        const_cast<Memory*>(&memory));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kTasks * kPerTask));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(kTasks * kPerTask * kMicroFloats * 8));
}

}  // namespace

void register_stream() {
  const auto with_threads = [](benchmark::internal::Benchmark* b) {
    b->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
  };
  for (const Row& row : kRows) {
    const int arrays = row.loop == read4_write2 ? 6 : row.loop == scale_in_place ? 1 : row.bytes / 4;
    with_threads(
        benchmark::RegisterBenchmark((std::string("machine/stream_") + row.name).c_str(), stream, row, arrays));
  }
  with_threads(benchmark::RegisterBenchmark("machine/l2_triad", l2_triad));
  with_threads(benchmark::RegisterBenchmark("machine/random_micro_4k", random_micro, false));
  with_threads(benchmark::RegisterBenchmark("machine/random_micro_2m", random_micro, true));
}

}  // namespace evigrid::bench
