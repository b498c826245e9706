// SPDX-License-Identifier: Apache-2.0
// The spinning executor: every index once however runs follow each other, sleep after the stated time, nested and
// concurrent runs, exceptions, fork, and an end at any moment. Needs nothing but its own threads, so that the thread
// sanitizer sees all of it.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "evigrid/executor.hpp"
#include "sanitizer.hpp"

namespace evigrid {
namespace {

using std::chrono::microseconds;

/// Plain counters: that each index is run by one thread only, and that the runs are ordered, is part of the test.
struct Count {
  std::vector<int> times;
  std::atomic<int> outside{0};
  int workers;
};
void count_all(Executor& e, Count& c) {
  e.run(
      static_cast<std::int64_t>(c.times.size()),
      [](void* p, std::int64_t i, int worker) {
        auto& all = *static_cast<Count*>(p);
        ++all.times[static_cast<std::size_t>(i)];
        if (worker < 0 || worker >= all.workers) ++all.outside;
      },
      &c);
}

TEST(Spin, ManyRunsOfManySizesEveryIndexOnce) {
  for (const microseconds spin : {microseconds(0), microseconds(50), microseconds(20'000)}) {
    for (const int threads : {1, 2, 3, 7}) {
      const auto e = make_spinning_executor(threads, spin);
      EXPECT_EQ(e->concurrency(), threads);
      for (int round = 0; round < 200; ++round) {
        const std::size_t n = static_cast<std::size_t>(round) * 7 % 50;
        Count c{std::vector<int>(n), {}, threads};
        count_all(*e, c);
        EXPECT_EQ(std::accumulate(c.times.begin(), c.times.end(), 0), static_cast<int>(n));
        for (const int t : c.times) ASSERT_EQ(t, 1);
        EXPECT_EQ(c.outside, 0);
        if (round % 20 == 0) std::this_thread::sleep_for(microseconds(300));  // some of them asleep
      }
    }
  }
}

TEST(Spin, OthersSleepAfterTheStatedTime) {
  const auto e = make_spinning_executor(2, microseconds(2000));
  Count c{std::vector<int>(100), {}, 2};
  count_all(*e, c);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  timespec before{}, after{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &before);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &after);
  const double busy_s =
      static_cast<double>(after.tv_sec - before.tv_sec) + 1e-9 * static_cast<double>(after.tv_nsec - before.tv_nsec);
  EXPECT_LT(busy_s, 0.02);
  Count again{std::vector<int>(100), {}, 2};
  count_all(*e, again);
  for (const int t : again.times) EXPECT_EQ(t, 1);
}

TEST(Spin, RunFromInsideATaskStaysOnItsThread) {
  struct Outer {
    Executor& e;
    std::atomic<int> inner{0}, strayed{0};
  } outer{*make_spinning_executor(3).release()};
  const std::unique_ptr<Executor> owned(&outer.e);
  outer.e.run(
      20,
      [](void* p, std::int64_t, int worker) {
        struct Inner {
          Outer& o;
          int worker;
          std::thread::id thread;
        } inner{*static_cast<Outer*>(p), worker, std::this_thread::get_id()};
        inner.o.e.run(
            5,
            [](void* q, std::int64_t, int w) {
              auto& in = *static_cast<Inner*>(q);
              ++in.o.inner;
              if (w != in.worker || std::this_thread::get_id() != in.thread) ++in.o.strayed;
            },
            &inner);
      },
      &outer);
  EXPECT_EQ(outer.inner, 100);
  EXPECT_EQ(outer.strayed, 0);
}

TEST(Spin, RunsFromSeveralThreadsAtOnce) {
  const auto e = make_spinning_executor(3, microseconds(100));
  std::atomic<int> wrong{0};
  std::vector<std::thread> hosts;
  for (int h = 0; h < 4; ++h) {
    hosts.emplace_back([&] {
      for (int round = 0; round < 100; ++round) {
        Count c{std::vector<int>(30), {}, 3};
        count_all(*e, c);
        for (const int t : c.times) wrong += t != 1;
      }
    });
  }
  for (auto& h : hosts) h.join();
  EXPECT_EQ(wrong, 0);
}

TEST(Spin, ATasksExceptionComesOutAndTheNextRunIsWhole) {
  const auto e = make_spinning_executor(2);
  const auto fails = [](void*, std::int64_t i, int) {
    if (i % 7 == 3) throw std::runtime_error("task");
  };
  for (int round = 0; round < 20; ++round) EXPECT_THROW(e->run(30, fails, nullptr), std::runtime_error);
  Count c{std::vector<int>(30), {}, 2};
  count_all(*e, c);
  for (const int t : c.times) EXPECT_EQ(t, 1);
}

TEST(Spin, EndsAtAnyMoment) {
  for (int round = 0; round < 100; ++round) {
    const auto e = make_spinning_executor(3, microseconds(round % 2 == 0 ? 20'000 : 0));
    if (round % 3 == 0) continue;  // before any work
    Count c{std::vector<int>(10), {}, 3};
    count_all(*e, c);
    if (round % 3 == 1) std::this_thread::sleep_for(microseconds(200));
  }
}

TEST(Spin, AForkedChildRunsAloneAndLeavesCleanly) {
  if (testing::kThreadSanitizer) GTEST_SKIP() << "the thread sanitizer does not follow threads over fork";
  for (const microseconds spin : {microseconds(0), microseconds(20'000)}) {
    auto e = make_spinning_executor(2, spin);
    Count c{std::vector<int>(10), {}, 2};
    count_all(*e, c);
    std::this_thread::sleep_for(microseconds(500));
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      alarm(10);
      count_all(*e, c);
      e.reset();
      _exit(std::accumulate(c.times.begin(), c.times.end(), 0) == 20 ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
    count_all(*e, c);  // the parent goes on
    EXPECT_EQ(std::accumulate(c.times.begin(), c.times.end(), 0), 20);
  }
}

}  // namespace
}  // namespace evigrid
