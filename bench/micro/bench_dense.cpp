// SPDX-License-Identifier: Apache-2.0
// Dense combination beside memory loops of the same pattern, on the same arrays, in the same binary and run. Names:
// CASE/RULE/cells:N/threads:T. Counters: `bytes_per_cell` as counted (reads and writes, no write-allocate),
// `yardstick_share` = cells/s over those of the memory loop of the same pattern, size and threads: the loop runs in
// every round beside the rule, a machine's speed drifts by half within seconds; the median of the rounds' ratios, of
// the faster loop where there are two. Each round starts from fresh masses, outside the clock: combined again and again
// they would end in denormals, which some processors take a hundred times as long for. Arrays are aligned to 2 MB and
// ask for huge pages. Usage: bench_dense [--benchmark_filter=...]; one family of sizes at a time is quickest.
#include <benchmark/benchmark.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/peers/alternate.hpp"
#include "evigrid/evigrid.hpp"

namespace {

using namespace evigrid;
using Clock = std::chrono::steady_clock;

/// Zeroed memory on huge pages where the system has them.
template <class T>
class Plane {
 public:
  explicit Plane(std::size_t n) : bytes_((n * sizeof(T) + kHuge - 1) / kHuge * kHuge + kHuge) {
    base_ = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (base_ == MAP_FAILED) throw std::bad_alloc();
    const auto at = (reinterpret_cast<std::uintptr_t>(base_) + kHuge - 1) / kHuge * kHuge;
    data_ = reinterpret_cast<T*>(at);
    madvise(data_, bytes_ - kHuge, MADV_HUGEPAGE);
  }
  ~Plane() { munmap(base_, bytes_); }
  Plane(const Plane&) = delete;
  Plane& operator=(const Plane&) = delete;
  T* data() { return data_; }

 private:
  static constexpr std::size_t kHuge = std::size_t{2} << 20;
  std::size_t bytes_;
  void* base_;
  T* data_;
};

/// e, o, u of n cells, mixed and reproducible.
struct Masses {
  Plane<float> e, o, u;
  Masses(std::size_t n, float base, unsigned salt) : e(n), o(n), u(n) {
    for (std::size_t i = 0; i < n; ++i) {
      e.data()[i] = base + 0.3f * static_cast<float>((i + salt) * 2654435761u >> 16 & 0xffff) / 65536;
      o.data()[i] = base + 0.3f * static_cast<float>((i + salt) * 40503u >> 4 & 0xffff) / 65536;
      u.data()[i] = 1 - e.data()[i] - o.data()[i];
    }
  }
  Planes<float> planes() { return {e.data(), o.data(), u.data()}; }
  Planes<const float> view() { return {e.data(), o.data(), u.data()}; }
};

constexpr std::size_t kSources = 8;
struct Arrays {
  std::size_t n;
  Masses fresh, a, c;
  std::vector<std::unique_ptr<Masses>> b;
  Plane<std::uint16_t> fresh_e, fresh_o, ae, ao, be, bo;
  explicit Arrays(std::size_t cells, std::size_t sources)
      : n(cells), fresh(n, 0.05f, 0), a(n, 0.05f, 0), c(n, 0, 1), fresh_e(n), fresh_o(n), ae(n), ao(n), be(n), bo(n) {
    for (std::size_t s = 0; s < sources; ++s)
      b.push_back(std::make_unique<Masses>(n, 0.02f, 7 * static_cast<unsigned>(s)));
    to_unorm16(fresh.view(), {fresh_e.data(), fresh_o.data()}, n);
    to_unorm16(b[0]->view(), {be.data(), bo.data()}, n);
  }
  void renew() {
    std::memcpy(a.e.data(), fresh.e.data(), 4 * n);
    std::memcpy(a.o.data(), fresh.o.data(), 4 * n);
    std::memcpy(a.u.data(), fresh.u.data(), 4 * n);
    std::memcpy(ae.data(), fresh_e.data(), 2 * n);
    std::memcpy(ao.data(), fresh_o.data(), 2 * n);
  }
};
Arrays& arrays(std::size_t n, std::size_t sources = 1) {  // kept: first touch is not what is measured
  static std::unique_ptr<Arrays> kept;
  if (!kept || kept->n != n || kept->b.size() < sources) {
    kept.reset();
    kept = std::make_unique<Arrays>(n, sources);
  }
  return *kept;
}

/// Compiled for the widest vectors of the processor, as the kernels are: a yardstick must not be the weaker side.
#define EVIGRID_WIDEST __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
using Words = std::uint32_t;  // plain sums: nothing but memory is measured

/// a += b on `streams` pairs of planes, four lines of each in turn.
EVIGRID_WIDEST void add_in_bursts(Words* const* a, const Words* const* b, std::size_t streams, std::size_t n) {
  constexpr std::size_t kBurst = 64;
  for (std::size_t i = 0; i < n; i += kBurst) {
    for (std::size_t s = 0; s < streams; ++s) {
      Words* __restrict x = a[s] + i;
      const Words* __restrict y = b[s] + i;
      for (std::size_t j = 0; j < kBurst; ++j) x[j] += y[j];
    }
  }
}
/// The same, a plane at a time.
EVIGRID_WIDEST void add_plane(Words* __restrict a, const Words* __restrict b, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) a[i] += b[i];
}
EVIGRID_WIDEST void triad(float* __restrict a, const float* __restrict b, const float* __restrict c, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 3.0f * c[i];
}
EVIGRID_WIDEST void copy(float* __restrict a, const float* __restrict b, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) a[i] = b[i];
}

std::unique_ptr<Executor> threads_of(std::int64_t n) {
  return n == 1 ? make_serial_executor() : make_spinning_executor(static_cast<int>(n));
}

constexpr std::size_t kBlock = 1 << 16;
/// In the blocks that combine() takes, over the same executor.
template <class Body>
void in_blocks(Executor& executor, std::size_t n, const Body& body) {
  struct Context {
    const Body& body;
    std::size_t n;
  } context{body, n};
  executor.run(
      static_cast<std::int64_t>((n + kBlock - 1) / kBlock),
      [](void* p, std::int64_t i, int) {
        const auto& c = *static_cast<Context*>(p);
        const std::size_t begin = static_cast<std::size_t>(i) * kBlock;
        c.body(begin, std::min(kBlock, c.n - begin));
      },
      &context);
}

using Round = std::function<void(Arrays&, Executor&)>;
/// What a rule is held against.
struct Yardstick {
  std::vector<Round> loops;  ///< the fastest counts
  double scale = 1;          ///< bytes of a cell of the rule over those of one of the loop
  bool on_masses = false;    ///< its operands, too, must be fresh
};

double seconds(const Round& round, Arrays& x, Executor& executor, int repeats) {
  const auto begin = Clock::now();
  for (int i = 0; i < repeats; ++i) round(x, executor);
  return std::chrono::duration<double>(Clock::now() - begin).count() / repeats;
}

void measure(benchmark::State& state, const Yardstick& yardstick, double bytes, std::size_t sources,
             const Round& round) {
  const auto n = static_cast<std::size_t>(state.range(0));
  Arrays& x = arrays(n, sources);
  const auto executor = threads_of(state.range(1));
  const int repeats = n < (std::size_t{1} << 16) ? 4 : 1;  // fewer than make denormals, enough for the clock
  std::vector<double> rates;
  std::vector<std::vector<double>> shares(yardstick.loops.size());
  x.renew();
  round(x, *executor);
  for (auto _ : state) {
    x.renew();
    if (repeats > 1) round(x, *executor);  // in cache
    const double s = seconds(round, x, *executor, repeats);
    state.SetIterationTime(s);
    rates.push_back(static_cast<double>(n) / s);
    for (std::size_t i = 0; i < shares.size(); ++i) {
      if (yardstick.on_masses) x.renew();
      shares[i].push_back(yardstick.scale * seconds(yardstick.loops[i], x, *executor, repeats) / s);
    }
  }
  if (!shares.empty()) {
    double share = bench::median(shares[0]);
    for (const auto& of_loop : shares) share = std::min(share, bench::median(of_loop));
    state.counters["yardstick_share"] = share;
  }
  state.counters["best_cells_per_s"] = *std::max_element(rates.begin(), rates.end());
  state.counters["bytes_per_cell"] = bytes;
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n));
}

void add_in_turns(Arrays& x, Executor& executor, bool plane_by_plane) {
  in_blocks(executor, x.n, [&](std::size_t at, std::size_t n) {
    Masses& b = *x.b[0];
    const auto word = [&](float* p) { return reinterpret_cast<Words*>(p) + at; };
    Words* to[3] = {word(x.a.e.data()), word(x.a.o.data()), word(x.a.u.data())};
    const Words* from[3] = {word(b.e.data()), word(b.o.data()), word(b.u.data())};
    if (plane_by_plane) {
      for (int p = 0; p < 3; ++p) add_plane(to[p], from[p], n);
    } else {
      add_in_bursts(to, from, 3, n / 64 * 64);
    }
  });
}
void add_bursts(Arrays& x, Executor& executor) { add_in_turns(x, executor, false); }
void add_planes(Arrays& x, Executor& executor) { add_in_turns(x, executor, true); }
void add_unorm16(Arrays& x, Executor& executor) {
  in_blocks(executor, x.n, [&](std::size_t at, std::size_t n) {
    const auto word = [&](std::uint16_t* p) { return reinterpret_cast<Words*>(p + at); };
    add_plane(word(x.ae.data()), word(x.be.data()), n / 2);
    add_plane(word(x.ao.data()), word(x.bo.data()), n / 2);
  });
}
void triad_once(Arrays& x, Executor& executor) {
  in_blocks(executor, x.n, [&](std::size_t at, std::size_t n) {
    triad(x.c.e.data() + at, x.a.e.data() + at, x.b[0]->e.data() + at, n);
  });
}

void loop_in_place(benchmark::State& state, bool plane_by_plane) {
  measure(state, {}, 36, 1, plane_by_plane ? add_planes : add_bursts);
}
void loop_unorm16(benchmark::State& state) { measure(state, {}, 12, 1, add_unorm16); }
/// STREAM: 12 bytes an element.
void loop_triad(benchmark::State& state) { measure(state, {}, 12, 1, triad_once); }
void loop_copy(benchmark::State& state) {
  measure(state, {}, 8, 1, [](Arrays& x, Executor& executor) {
    in_blocks(executor, x.n, [&](std::size_t at, std::size_t n) { copy(x.c.e.data() + at, x.a.e.data() + at, n); });
  });
}

void in_place(benchmark::State& state, Rule rule) {
  measure(state, {{add_bursts, add_planes}}, 36, 1, [rule](Arrays& x, Executor& executor) {
    combine(rule, x.a.view(), x.b[0]->view(), x.a.planes(), nullptr, x.n, Kernel::automatic, &executor);
  });
}
/// 36 bytes a cell against the 12 of a triad's element.
void out_of_place(benchmark::State& state, Rule rule) {
  measure(state, {{triad_once}, 3, true}, 36, 1, [rule](Arrays& x, Executor& executor) {
    combine(rule, x.a.view(), x.b[0]->view(), x.c.planes(), nullptr, x.n, Kernel::automatic, &executor);
  });
}
void unorm16_in_place(benchmark::State& state, Rule rule) {
  measure(state, {{add_unorm16}}, 12, 1, [rule](Arrays& x, Executor& executor) {
    combine(rule, Unorm16Planes<const std::uint16_t>{x.ae.data(), x.ao.data()}, {x.be.data(), x.bo.data()},
            {x.ae.data(), x.ao.data()}, nullptr, x.n, Kernel::automatic, &executor);
  });
}

/// Eight sources into the state: cells count once.
Round passes(Rule rule) {
  return [rule](Arrays& x, Executor& executor) {
    for (const auto& b : x.b)
      combine(rule, x.a.view(), b->view(), x.a.planes(), nullptr, x.n, Kernel::automatic, &executor);
  };
}
void eight_passes(benchmark::State& state, Rule rule) { measure(state, {}, 8 * 36, kSources, passes(rule)); }
/// `yardstick_share` of the passes is the gain.
void one_pass(benchmark::State& state, Rule rule) {
  measure(state, {{passes(rule)}, 1, true}, (kSources + 2) * 12, kSources, [rule](Arrays& x, Executor& executor) {
    std::vector<Planes<const float>> all{x.a.view()};
    for (const auto& b : x.b) all.push_back(b->view());
    combine(rule, std::span<const Planes<const float>>(all), x.a.planes(), nullptr, x.n, Kernel::automatic, &executor);
  });
}

constexpr std::int64_t kLarge[] = {16 << 20, 64 << 20}, kCached[] = {1 << 10, 16 << 10, 50'000, 1 << 20};

void plan(benchmark::internal::Benchmark* b, std::int64_t cells, std::int64_t threads, int rounds) {
  b->Args({cells, threads})->ArgNames({"cells", "threads"})->UseManualTime()->Unit(benchmark::kMillisecond);
  b->Iterations(rounds);
}

void add(const std::string& label, Rule rule, void (*run)(benchmark::State&, Rule), std::int64_t cells,
         std::int64_t threads, int rounds) {
  plan(benchmark::RegisterBenchmark((label + "/" + std::string(name(rule))).c_str(), run, rule), cells, threads,
       rounds);
}

void register_all() {
  std::vector<Rule> rules;  // one of those that share a kernel
  for (const Rule rule : all_rules()) {
    if (same_as(rule) == rule) rules.push_back(rule);
  }
  const auto families = [&](std::int64_t cells, std::int64_t threads, int rounds, bool many) {
    plan(benchmark::RegisterBenchmark("loop_in_place/bursts", loop_in_place, false), cells, threads, rounds);
    plan(benchmark::RegisterBenchmark("loop_in_place/plane_by_plane", loop_in_place, true), cells, threads, rounds);
    for (const Rule rule : rules) add("in_place", rule, in_place, cells, threads, rounds);
    plan(benchmark::RegisterBenchmark("loop_triad", loop_triad), cells, threads, rounds);
    plan(benchmark::RegisterBenchmark("loop_copy", loop_copy), cells, threads, rounds);
    for (const Rule rule : rules) add("out_of_place", rule, out_of_place, cells, threads, rounds);
    plan(benchmark::RegisterBenchmark("loop_unorm16", loop_unorm16), cells, threads, rounds);
    for (const Rule rule : rules) {
      if (rule != Rule::conjunctive) add("unorm16", rule, unorm16_in_place, cells, threads, rounds);
    }
    if (!many) return;
    for (const Rule rule : {Rule::dempster, Rule::pcr5}) {
      add("eight_passes", rule, eight_passes, cells, threads, rounds);
      add("one_pass", rule, one_pass, cells, threads, rounds);
    }
  };
  for (const std::int64_t threads : {1, 2}) families(kLarge[0], threads, 9, true);
  for (const std::int64_t threads : {1, 2}) families(kLarge[1], threads, 5, false);
  for (const std::int64_t cells : kCached) families(cells, 1, 31, false);
}

const bool registered = (register_all(), true);

}  // namespace
