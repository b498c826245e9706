// SPDX-License-Identifier: Apache-2.0
// Threads that look for work for a stated time before they sleep. Indices are claimed one by one from `ticket`, whose
// high half is the number of the run and whose low half is how many indices are left: a claim that succeeds is valid
// for the run it names, however late the thread comes, and the caller waits only for claimed ones.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "evigrid/executor.hpp"

namespace evigrid {
namespace {

using Clock = std::chrono::steady_clock;

inline void relax() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

constexpr std::uint64_t kLeft = 0xffffffff;

struct Team;
/// The team whose task this thread is in, and as which worker: a run from inside stays on the thread.
thread_local const Team* inside = nullptr;
thread_local int inside_as = 0;

struct Team {
  std::atomic<std::uint64_t> ticket{0};
  std::atomic<std::int64_t> finished{0};
  Executor::Task task = nullptr;  // these four belong to the run that `ticket` names
  void* context = nullptr;
  std::int64_t first = 0, count = 0;
  std::exception_ptr thrown;
  std::mutex throwing;

  std::mutex running;  // one run at a time
  std::mutex sleep;
  std::condition_variable wake;
  std::atomic<int> sleepers{0};
  std::atomic<bool> stop{false};
  std::chrono::microseconds spin{};
  bool crowded = false;  // more threads than processors: spinning must give way
  std::vector<std::thread> threads;

  /// Claims indices until none is left.
  void work(int worker) {
    const Team* const outer = std::exchange(inside, this);
    const int outer_as = std::exchange(inside_as, worker);
    std::uint64_t t = ticket.load(std::memory_order_acquire);
    while ((t & kLeft) != 0) {
      if (!ticket.compare_exchange_weak(t, t - 1, std::memory_order_acq_rel, std::memory_order_acquire)) continue;
      try {
        task(context, first + count - static_cast<std::int64_t>(t & kLeft), worker);
      } catch (...) {
        const std::lock_guard hold(throwing);
        if (!thrown) thrown = std::current_exception();
      }
      finished.fetch_add(1, std::memory_order_release);
      t = ticket.load(std::memory_order_acquire);
    }
    inside = outer;
    inside_as = outer_as;
  }

  void live(int worker) {
    std::uint64_t seen = 0;  // number of the last run looked at
    while (!stop.load(std::memory_order_acquire)) {
      if (!await_run(seen)) return;
      seen = ticket.load(std::memory_order_acquire) >> 32;
      work(worker);
    }
  }

  [[nodiscard]] bool news(std::uint64_t seen) const noexcept {
    return ticket.load(std::memory_order_seq_cst) >> 32 != seen || stop.load(std::memory_order_acquire);
  }

  /// Spins for the stated time, then sleeps, until there is another run; false at the end of the team.
  bool await_run(std::uint64_t seen) {
    const auto until = Clock::now() + spin;
    do {
      for (int i = 0; i < 64; ++i) {
        if (news(seen)) return !stop.load(std::memory_order_acquire);
        relax();
      }
      if (crowded) std::this_thread::yield();
    } while (Clock::now() < until);
    std::unique_lock hold(sleep);
    sleepers.fetch_add(1, std::memory_order_seq_cst);  // before the last look: run() looks after its ticket
    wake.wait(hold, [&] { return news(seen); });
    sleepers.fetch_sub(1, std::memory_order_relaxed);
    return !stop.load(std::memory_order_acquire);
  }

  void wake_sleepers() {
    if (sleepers.load(std::memory_order_seq_cst) == 0) return;
    { const std::lock_guard hold(sleep); }  // whoever looked in vain is in wait() now
    wake.notify_all();
  }

  /// count is at most kLeft.
  void run(std::int64_t from, std::int64_t how_many, Executor::Task t, void* c) {
    task = t, context = c, first = from, count = how_many;
    finished.store(0, std::memory_order_relaxed);
    const std::uint64_t number = (ticket.load(std::memory_order_relaxed) >> 32) + 1;
    ticket.store(number << 32 | static_cast<std::uint64_t>(how_many), std::memory_order_seq_cst);
    wake_sleepers();
    work(0);
    for (int i = 0; finished.load(std::memory_order_acquire) != how_many; ++i) {
      crowded || i > 4096 ? std::this_thread::yield() : relax();
    }
    if (thrown) std::rethrow_exception(std::exchange(thrown, nullptr));
  }
};

class Spinning final : public Executor {
 public:
  Spinning(int threads, std::chrono::microseconds spin) : team_(new Team) {
    const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    threads_ = threads > 0 ? threads : processors;
    team_->spin = spin;
    team_->crowded = threads_ > processors;
    try {
      for (int worker = 1; worker < threads_; ++worker) {
        team_->threads.emplace_back([team = team_, worker] { team->live(worker); });
      }
    } catch (...) {
      end();
      throw;
    }
  }
  ~Spinning() override { end(); }
  Spinning(const Spinning&) = delete;
  Spinning& operator=(const Spinning&) = delete;

  [[nodiscard]] int concurrency() const noexcept override { return threads_; }
  [[nodiscard]] std::string_view name() const noexcept override { return "spin"; }

  void run(std::int64_t count, Task task, void* context) override {
    const bool nested = inside == team_;
    if (count <= 1 || threads_ == 1 || nested || getpid() != owner_) return alone(count, task, context, nested);
    const std::unique_lock only(team_->running, std::try_to_lock);
    if (!only.owns_lock()) return alone(count, task, context, false);
    constexpr auto kMost = static_cast<std::int64_t>(kLeft);
    for (std::int64_t from = 0; from < count; from += kMost) {
      team_->run(from, std::min(kMost, count - from), task, context);
    }
  }

 private:
  static void alone(std::int64_t count, Task task, void* context, bool nested) {
    for (std::int64_t i = 0; i < count; ++i) task(context, i, nested ? inside_as : 0);
  }

  void end() {
    if (getpid() != owner_) {  // a forked child has none of the threads, and may have inherited a held lock
      for (std::thread& t : team_->threads) t.detach();
      return;
    }
    team_->stop.store(true, std::memory_order_seq_cst);
    { const std::lock_guard hold(team_->sleep); }
    team_->wake.notify_all();
    for (std::thread& t : team_->threads) t.join();
    delete team_;
  }

  Team* team_;
  int threads_ = 1;
  const pid_t owner_ = getpid();
};

}  // namespace

std::unique_ptr<Executor> make_spinning_executor(int threads, std::chrono::microseconds spin) {
  return std::make_unique<Spinning>(threads, spin);
}

}  // namespace evigrid
