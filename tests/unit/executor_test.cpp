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

void run(Executor& e, Seen& seen, int wait_us) {
  struct Context {
    Seen& seen;
    int wait_us;
  } context{seen, wait_us};
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
        std::this_thread::sleep_for(std::chrono::microseconds(c.wait_us));
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
      run(*e, seen, 0);
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
      run(*e, after, 0);
      for (const auto& t : after.times) EXPECT_EQ(t, 1);
    }
  }
}

TEST(Executor, TheThreadsAskedForReallyRun) {
  if (testing::kThreadSanitizer)
    GTEST_SKIP() << "TBB and OpenMP of the distribution are not instrumented for the thread sanitizer";
  Seen serial(50), openmp(700);
  run(*make_serial_executor(), serial, 10);
  EXPECT_EQ(serial.threads.size(), 1u);
  run(*make_openmp_executor(7), openmp, 300);
  EXPECT_EQ(openmp.threads.size(), 7u);
  Seen spin(700);
  run(*make_spinning_executor(7), spin, 300);
  EXPECT_EQ(spin.threads.size(), 7u);
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor: TBB runs one thread here";
  Seen tbb(400);
  run(*make_tbb_executor(2), tbb, 500);
  EXPECT_EQ(tbb.threads.size(), 2u);
}

}  // namespace
}  // namespace evigrid
