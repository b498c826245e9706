// SPDX-License-Identifier: Apache-2.0
// The same bits from every kernel, executor, number of threads and batch size, for every rule and model; and the kernel
// that was asked for is the one that ran.
#include <gtest/gtest.h>
#include <immintrin.h>

#include <atomic>
#include <thread>

#include "equivalence/random_scans.hpp"
#include "sanitizer.hpp"

namespace evigrid::testing {
namespace {

std::vector<Kernel> kernels_here() {
  std::vector<Kernel> out;
  for (const Kernel k : {Kernel::scalar, Kernel::avx2, Kernel::avx512}) {
    if (kernel_available(k)) out.push_back(k);
  }
  return out;
}

class SameBits : public ::testing::TestWithParam<std::tuple<Rule, Model>> {};

TEST_P(SameBits, AcrossKernels) {
  const auto [rule, model] = GetParam();
  const auto d = drive(model, 25, 11);
  const MapParams params{.rule = rule, .kernel = Kernel::scalar};
  const Outcome scalar = fuse(*d, params, make_serial_executor());
  ASSERT_EQ(scalar.kernel, "scalar");
  ASSERT_GT(scalar.report.cells_updated, 50000u);
  for (const Kernel k : kernels_here()) {
    MapParams p = params;
    p.kernel = k;
    const Outcome o = fuse(*d, p, make_serial_executor());
    EXPECT_EQ(o.kernel, name(k));
    EXPECT_EQ(o.hash, scalar.hash) << name(k);
    EXPECT_EQ(o.report.cells_updated, scalar.report.cells_updated);
    EXPECT_EQ(o.report.max_conflict, scalar.report.max_conflict);
    EXPECT_EQ(o.report.total_conflicts, scalar.report.total_conflicts);
  }
  if (kernels_here().size() < 3) GTEST_SKIP() << "this processor lacks AVX2 or AVX-512: those tables were not compared";
}

/// The host's own threads, as a robot would hand them in; also what the thread sanitizer can see into.
class HostThreads final : public Executor {
 public:
  explicit HostThreads(int threads) : threads_(threads) {}
  int concurrency() const noexcept override { return threads_; }
  std::string_view name() const noexcept override { return "host"; }
  void run(std::int64_t count, Task task, void* context) override {
    std::atomic<std::int64_t> next{0};
    std::vector<std::thread> pool;
    for (int worker = 0; worker < threads_; ++worker) {
      pool.emplace_back([&, worker] {
        for (std::int64_t i = next++; i < count; i = next++) task(context, i, worker);
      });
    }
    for (auto& t : pool) t.join();
  }

 private:
  int threads_;
};

TEST_P(SameBits, OnTheHostsThreads) {
  const auto [rule, model] = GetParam();
  const auto d = drive(model, 20, 12);
  const Outcome serial = fuse(*d, {.rule = rule}, make_serial_executor(), 1);
  const Outcome host = fuse(*d, {.rule = rule}, std::make_shared<HostThreads>(5), 9);
  EXPECT_EQ(host.executor, "host");
  EXPECT_EQ(host.hash, serial.hash);
}

TEST_P(SameBits, OnSpinningThreads) {
  const auto [rule, model] = GetParam();
  const auto d = drive(model, 20, 12);
  const Outcome serial = fuse(*d, {.rule = rule}, make_serial_executor(), 1);
  const Outcome spin = fuse(*d, {.rule = rule}, make_spinning_executor(3, std::chrono::microseconds(100)), 5);
  EXPECT_EQ(spin.executor, "spin");
  EXPECT_EQ(spin.hash, serial.hash);
}

TEST_P(SameBits, AcrossThreadsExecutorsAndBatches) {
  if (kThreadSanitizer)
    GTEST_SKIP() << "TBB and OpenMP of the distribution are not instrumented for the thread sanitizer";
  const auto [rule, model] = GetParam();
  const auto d = drive(model, 20, 12);
  const MapParams params{.rule = rule};
  const Outcome serial = fuse(*d, params, make_serial_executor(), 1);
  for (const char* executor : {"tbb", "openmp", "spin"}) {
    for (const int threads : {1, 2, 7}) {
      const Outcome o = fuse(*d, params, make_executor(executor, threads), static_cast<std::size_t>(threads) * 3);
      EXPECT_EQ(o.executor, executor);
      EXPECT_EQ(o.hash, serial.hash) << executor << threads;
      EXPECT_EQ(o.report.cells_updated, serial.report.cells_updated);
    }
  }
}

/// A host that flushes denormals to zero gets the same map: none ever arises.
TEST_P(SameBits, WithDenormalsFlushedToZero) {
  const auto [rule, model] = GetParam();
  const auto d = drive(model, 25, 13);
  const MapParams params{.rule = rule};
  const Outcome plain = fuse(*d, params, make_serial_executor());
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8040);
  const Outcome flushed = fuse(*d, params, make_serial_executor());
  _mm_setcsr(before);
  EXPECT_EQ(plain.hash, flushed.hash);
}

std::vector<std::tuple<Rule, Model>> allowed_pairs() {
  std::vector<std::tuple<Rule, Model>> out;
  for (const Rule rule : map_rules()) {
    for (const Model model : all_models()) {
      if (model != Model::beam && why_not_together(rule, model).empty()) out.emplace_back(rule, model);
    }
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(All, SameBits, ::testing::ValuesIn(allowed_pairs()), [](const auto& which) {
  return std::string(name(std::get<0>(which.param))) + "_" + std::string(name(std::get<1>(which.param)));
});

}  // namespace
}  // namespace evigrid::testing
