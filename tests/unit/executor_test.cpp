// SPDX-License-Identifier: Apache-2.0
// One signature, four executors: every index once, workers within bounds, and the threads asked for really run.
#include "evigrid/executor.hpp"

#include "sanitizer.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace evigrid {
namespace {

struct Seen {
  std::vector<std::atomic<int>> times;
  std::mutex lock;
  std::set<std::thread::id> threads;
  std::set<int> workers;
  explicit Seen(std::size_t n) : times(n) {}
};

/// Every task waits until so many threads have come, for half a minute at most.
void run(Executor& e, Seen& seen, std::size_t threads = 1) {
  struct Context {
    Seen& seen;
    std::size_t threads;
    std::chrono::steady_clock::time_point until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    [[nodiscard]] bool all_came() {
      const std::lock_guard hold(seen.lock);
      return seen.threads.size() >= threads;
    }
  } context{seen, threads};
  e.run(
      static_cast<std::int64_t>(seen.times.size()),
      [](void* p, std::int64_t i, int worker) {
        auto& c = *static_cast<Context*>(p);
        ++c.seen.times[static_cast<std::size_t>(i)];
        {
          const std::lock_guard hold(c.seen.lock);
          c.seen.threads.insert(std::this_thread::get_id());
          c.seen.workers.insert(worker);
        }
        while (!c.all_came() && std::chrono::steady_clock::now() < c.until)
          std::this_thread::sleep_for(std::chrono::microseconds(50));
      },
      &context);
}

TEST(Executor, EveryIndexOnceAndWorkersInRange) {
  if (testing::kThreadSanitizer)
    GTEST_SKIP() << "TBB and OpenMP of the distribution are not instrumented for the thread sanitizer";
  for (const char* name : {"serial", "tbb", "openmp", "spin"}) {
    for (const int threads : {1, 2, 7}) {
      const auto e = make_executor(name, threads);
      ASSERT_TRUE(e);
      EXPECT_EQ(e->name(), name);
      Seen seen(500);
      run(*e, seen);
      for (const auto& t : seen.times) EXPECT_EQ(t, 1);
      for (const int w : seen.workers) {
        EXPECT_GE(w, 0);
        EXPECT_LT(w, e->concurrency());
      }
    }
  }
  EXPECT_FALSE(make_executor("threads", 2));
}

TEST(Executor, AnExceptionOfATaskComesOutOfRun) {
  if (testing::kThreadSanitizer)
    GTEST_SKIP() << "TBB and OpenMP of the distribution are not instrumented for the thread sanitizer";
  for (const char* name : {"serial", "tbb", "openmp", "spin"}) {
    for (const int threads : {1, 2, 7}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(threads));
      const auto e = make_executor(name, threads);
      for (const int bad : {1, 90}) {  // one task of a hundred throws, or nearly all
        int context = bad;
        const auto task = [](void* p, std::int64_t i, int) {
          if (i >= 7 && i < 7 + *static_cast<const int*>(p)) throw std::length_error("task " + std::to_string(i));
        };
        EXPECT_THROW(e->run(100, task, &context), std::length_error);
      }
      Seen after(200);  // as if nothing had been
      run(*e, after);
      for (const auto& t : after.times) EXPECT_EQ(t, 1);
    }
  }
}

TEST(Executor, TheThreadsAskedForReallyRun) {
  if (testing::kThreadSanitizer)
    GTEST_SKIP() << "TBB and OpenMP of the distribution are not instrumented for the thread sanitizer";
  Seen serial(50), openmp(70), spin(70), tbb(40);
  run(*make_serial_executor(), serial);
  EXPECT_EQ(serial.threads.size(), 1u);
  run(*make_openmp_executor(7), openmp, 7);
  EXPECT_EQ(openmp.threads.size(), 7u);
  run(*make_spinning_executor(7), spin, 7);
  EXPECT_EQ(spin.threads.size(), 7u);
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor: TBB runs one thread here";
  run(*make_tbb_executor(2), tbb, 2);
  EXPECT_EQ(tbb.threads.size(), 2u);
}

}  // namespace
}  // namespace evigrid
